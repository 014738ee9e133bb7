#pragma once
/// \file
/// Export: everything that follows from the project, written into a folder in the background, with progress and a way to stop.

#include "document/build.hpp"
#include "ui/worker.hpp"

#include <filesystem>
#include <mutex>
#include <string>

namespace axil::ui {

struct ExportQuestion {
  document::OpenProject open;
  std::filesystem::path folder;
};

struct ExportAnswer {
  std::filesystem::path folder;
  Result<document::BuildReport> report = fail(ErrorCode::Cancelled, "not begun");
};

class Exporter {
 public:
  explicit Exporter(std::function<void()> answered);
  ~Exporter() { cancel(); }
  Exporter(const Exporter&) = delete;
  Exporter& operator=(const Exporter&) = delete;

  void begin(ExportQuestion question);
  void cancel();
  [[nodiscard]] bool running() const { return worker_.busy(); }
  [[nodiscard]] std::pair<std::string, double> progress() const;
  [[nodiscard]] std::optional<ExportAnswer> take() { return worker_.take(); }

 private:
  ExportAnswer work(const ExportQuestion& question);

  mutable std::mutex mutex_;
  std::string what_;
  double share_ = 0;
  std::shared_ptr<CancelToken> token_ = std::make_shared<CancelToken>();
  Worker<ExportQuestion, ExportAnswer> worker_;
};

}  // namespace axil::ui
