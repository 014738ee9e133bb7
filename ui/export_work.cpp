#include "ui/export_work.hpp"

namespace axil::ui {

Exporter::Exporter(std::function<void()> answered)
    : worker_([this] { return [this](const ExportQuestion& question) { return work(question); }; }, std::move(answered)) {}

ExportAnswer Exporter::work(const ExportQuestion& question) {
  std::shared_ptr<CancelToken> token;
  {
    const std::lock_guard lock(mutex_);
    token = token_;
  }
  document::BuildOptions options;
  options.chain.watch = {.progress = [this](std::string_view what, double share) {
                           const std::lock_guard lock(mutex_);
                           what_ = what;
                           share_ = share;
                         },
                         .cancel = token.get()};
  return {question.folder, document::build(question.open, question.folder, options)};
}

void Exporter::begin(ExportQuestion question) {
  {
    const std::lock_guard lock(mutex_);
    token_ = std::make_shared<CancelToken>();
    what_.clear();
    share_ = 0;
  }
  worker_.ask(std::move(question));
}

void Exporter::cancel() {
  const std::lock_guard lock(mutex_);
  token_->cancel();
}

std::pair<std::string, double> Exporter::progress() const {
  const std::lock_guard lock(mutex_);
  return {what_, share_};
}

}  // namespace axil::ui
