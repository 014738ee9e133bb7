#pragma once
/// \file
/// Result<T>: a value, or the Error that says why there is none. Spelled like std::expected, which C++20 lacks.
///
/// Which of the four kinds of trouble it serves is said in docs/architecture.md: an author's text collects Diagnostics
/// (base/source.hpp), data that give no answer return a Result, our own bugs stop at AXIL_ASSERT, and a package's
/// exception is turned into an Error in the file that talks to the package.

#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace axil {

enum class ErrorCode {
  BadInput,        ///< a file, a value or an option is wrong
  NotFound,        ///< a file, a view, a node that is named does not exist
  Unreadable,      ///< a file exists but cannot be read as what it should be
  Unwritable,      ///< an output cannot be written
  NoAnswer,        ///< the input is well formed but determines nothing (rays that do not meet, a stem of no length)
  LimitReached,    ///< a stated limit on size, depth or time
  Cancelled,       ///< the caller asked to stop
  BadGrammar,      ///< a grammar has errors; `details` lists them, one printed diagnostic each
};

/// What failed, on what, and what the user can do. `message` is one sentence for a person. `details` are further
/// lines of the same trouble (every wrong node, every diagnostic), each readable alone.
struct Error {
  ErrorCode code = ErrorCode::BadInput;
  std::string message;
  std::vector<std::string> details = {};

  friend bool operator==(const Error&, const Error&) = default;
};

/// Wraps an Error on its way into any Result<T>.
struct Failure {
  Error error;
};

[[nodiscard]] inline Failure fail(ErrorCode code, std::string message) { return {Error{code, std::move(message)}}; }
[[nodiscard]] inline Failure fail(Error error) { return {std::move(error)}; }

/// Ends the program with the reason; on in every build, since a stop beats a wrong measurement.
[[noreturn]] void assertionFailed(const char* condition, const char* why, const char* file, int line);

#define AXIL_ASSERT(condition, why) \
  ((condition) ? static_cast<void>(0) : ::axil::assertionFailed(#condition, why, __FILE__, __LINE__))

template <class T>
class [[nodiscard]] Result {
 public:
  using value_type = T;

  Result(T value) : content_(std::in_place_index<0>, std::move(value)) {}
  Result(Failure failure) : content_(std::in_place_index<1>, std::move(failure.error)) {}

  [[nodiscard]] bool has_value() const { return content_.index() == 0; }
  explicit operator bool() const { return has_value(); }

  [[nodiscard]] T& value() & { return *get(); }
  [[nodiscard]] const T& value() const& { return *get(); }
  [[nodiscard]] T&& value() && { return std::move(*get()); }
  [[nodiscard]] T& operator*() & { return *get(); }
  [[nodiscard]] const T& operator*() const& { return *get(); }
  [[nodiscard]] T&& operator*() && { return std::move(*get()); }
  [[nodiscard]] T* operator->() { return get(); }
  [[nodiscard]] const T* operator->() const { return get(); }

  [[nodiscard]] const Error& error() const {
    AXIL_ASSERT(!has_value(), "error() of a Result that holds a value");
    return *std::get_if<1>(&content_);
  }
  /// The failure, to hand on: `if (!x) return x.failure();`
  [[nodiscard]] Failure failure() const { return {error()}; }

 private:
  T* get() {
    AXIL_ASSERT(has_value(), "value of a Result that holds an error");
    return std::get_if<0>(&content_);
  }
  const T* get() const {
    AXIL_ASSERT(has_value(), "value of a Result that holds an error");
    return std::get_if<0>(&content_);
  }
  std::variant<T, Error> content_;
};

/// Success without a value, or an Error.
template <>
class [[nodiscard]] Result<void> {
 public:
  Result() = default;
  Result(Failure failure) : error_(std::move(failure.error)) {}

  [[nodiscard]] bool has_value() const { return !error_; }
  explicit operator bool() const { return has_value(); }
  [[nodiscard]] const Error& error() const {
    AXIL_ASSERT(error_.has_value(), "error() of a Result that succeeded");
    return *error_;
  }
  [[nodiscard]] Failure failure() const { return {error()}; }

 private:
  std::optional<Error> error_;
};

}  // namespace axil
