#pragma once
/// \file
/// ModuleString: what a derivation makes, a string of modules kept as two flat arrays, one byte a module and eight a parameter.
///
/// A *symbol* is a letter together with its number of parameters: A, A(x) and A(x, y) are three symbols. The string stores
/// symbol codes; `symbols()` says what they mean. Strings of grammars that draw random numbers carry an identity for each module,
/// six bytes (engine_identity.hpp). All parameters follow each other in a second array, so the parameters
/// of the n-th module start where those of the modules before it end: reading in order is free, reading at random is not offered.

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace axil::simeco {

/// `block` with room for `bytes`, of which the first `used` are kept; large blocks come in large pages, since a derivation touches
/// every page of a new string. To be given back with std::free.
[[nodiscard]] void* grownBlock(void* block, std::size_t used, std::size_t bytes);

/// Plain numbers in memory that grows without being written first: a derivation fills every element exactly once.
/// A few bytes beyond the end may be written too (`slack`), so that short copies need no tail.
template <class T>
class Buffer {
 public:
  static constexpr std::size_t slack = 64;  ///< elements that may be overwritten behind size()

  Buffer() = default;
  Buffer(const Buffer& other) { assign(other.span()); }
  Buffer(Buffer&& other) noexcept { swap(other); }
  Buffer& operator=(Buffer other) noexcept {
    swap(other);
    return *this;
  }
  ~Buffer() { std::free(data_); }

  void swap(Buffer& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    std::swap(capacity_, other.capacity_);
  }
  [[nodiscard]] T* data() { return data_; }
  [[nodiscard]] const T* data() const { return data_; }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] std::size_t capacity() const { return capacity_; }
  [[nodiscard]] std::size_t bytes() const { return data_ == nullptr ? 0 : (capacity_ + slack) * sizeof(T); }
  [[nodiscard]] std::span<const T> span() const { return {data_, size_}; }
  T& operator[](std::size_t i) { return data_[i]; }
  const T& operator[](std::size_t i) const { return data_[i]; }

  /// Room for `count` elements; what is there stays.
  void reserve(std::size_t count) {
    if (count <= capacity_ && data_ != nullptr) return;
    data_ = static_cast<T*>(grownBlock(data_, data_ == nullptr ? 0 : size_ * sizeof(T), (count + slack) * sizeof(T)));
    capacity_ = count;
  }
  /// A quarter more at least, so that appending one by one costs the same for each.
  void reserveMore(std::size_t count) {
    const std::size_t more = capacity_ + capacity_ / 4;
    if (count > capacity_ || data_ == nullptr) reserve(count > more ? count : more);
  }
  /// Gives room back where more than an eighth of what is filled is left over.
  void trim() {
    if (data_ == nullptr || capacity_ - size_ <= size_ / 8 + slack) return;
    if (void* const smaller = std::realloc(data_, (size_ + slack) * sizeof(T))) {
      data_ = static_cast<T*>(smaller);
      capacity_ = size_;
    }
  }
  /// Says how many elements are filled; their values are whatever was written there.
  void setSize(std::size_t size) {
    reserve(size);
    size_ = size;
  }
  void clear() { size_ = 0; }
  void push(T value) {
    reserveMore(size_ + 1);
    data_[size_++] = value;
  }
  void assign(std::span<const T> values) {
    setSize(values.size());
    if (!values.empty()) std::memcpy(data_, values.data(), values.size_bytes());
  }

 private:
  T* data_ = nullptr;
  std::size_t size_ = 0;
  std::size_t capacity_ = 0;
};

/// A letter with its number of parameters.
struct Symbol {
  std::string letter;
  int parameters = 0;
  friend bool operator==(const Symbol&, const Symbol&) = default;
};

using SymbolCode = std::uint8_t;

/// Who a module is by its ancestry: 48 bits, the lowest first (engine_identity.hpp).
struct Identity {
  std::array<std::uint16_t, 3> parts{};
  friend bool operator==(const Identity&, const Identity&) = default;
};
static_assert(sizeof(Identity) == 6);

/// So many different symbols one grammar may use: codes are bytes.
constexpr std::size_t maximumSymbols = 250;

/// A module of a derived string. It looks into the string it came from.
struct ModuleView {
  std::string_view letter;
  std::span<const double> parameters;
};

class ModuleString {
 public:
  ModuleString() = default;
  explicit ModuleString(std::shared_ptr<const std::vector<Symbol>> symbols) : symbols_(std::move(symbols)) {}

  /// Modules, brackets counted.
  [[nodiscard]] std::size_t size() const { return codes_.size(); }
  [[nodiscard]] bool empty() const { return size() == 0; }
  [[nodiscard]] const std::vector<Symbol>& symbols() const;
  [[nodiscard]] std::span<const SymbolCode> codes() const { return codes_.span(); }
  [[nodiscard]] std::span<const double> parameters() const { return parameters_.span(); }
  /// One a module, or none where nothing draws.
  [[nodiscard]] std::span<const Identity> identities() const { return identities_.span(); }
  /// Memory that the string holds.
  [[nodiscard]] std::size_t bytes() const { return codes_.bytes() + parameters_.bytes() + identities_.bytes(); }

  class Iterator {
   public:
    using iterator_category = std::forward_iterator_tag;
    using value_type = ModuleView;
    using difference_type = std::ptrdiff_t;
    using pointer = const ModuleView*;
    using reference = ModuleView;

    Iterator() = default;
    Iterator(const Symbol* symbols, const SymbolCode* code, const double* parameter) : symbols_(symbols), code_(code), parameter_(parameter) {}
    ModuleView operator*() const { return {symbol().letter, {parameter_, static_cast<std::size_t>(symbol().parameters)}}; }
    Iterator& operator++() {
      parameter_ += symbol().parameters;
      ++code_;
      return *this;
    }
    Iterator operator++(int) {
      const Iterator before = *this;
      ++*this;
      return before;
    }
    friend bool operator==(const Iterator& a, const Iterator& b) { return a.code_ == b.code_; }

   private:
    [[nodiscard]] const Symbol& symbol() const { return symbols_[*code_]; }
    const Symbol* symbols_ = nullptr;
    const SymbolCode* code_ = nullptr;
    const double* parameter_ = nullptr;
  };
  [[nodiscard]] Iterator begin() const { return {symbols().data(), codes_.data(), parameters_.data()}; }
  [[nodiscard]] Iterator end() const { return {symbols().data(), codes_.data() + codes_.size(), nullptr}; }

  /// For the engine: the arrays themselves.
  [[nodiscard]] Buffer<SymbolCode>& codeBuffer() { return codes_; }
  [[nodiscard]] Buffer<double>& parameterBuffer() { return parameters_; }
  [[nodiscard]] Buffer<Identity>& identityBuffer() { return identities_; }

  /// The same modules with the same parameters, compared by what they mean and bit by bit.
  friend bool operator==(const ModuleString& a, const ModuleString& b);

 private:
  std::shared_ptr<const std::vector<Symbol>> symbols_;
  Buffer<SymbolCode> codes_;
  Buffer<double> parameters_;
  Buffer<Identity> identities_;
};

/// How often each letter stands in the string, whatever its number of parameters.
[[nodiscard]] std::map<std::string, std::size_t> letterCounts(const ModuleString& string);

/// The string as text, `S(0)[rotr(0.915944)rotu(-2.10221)S(9)]`, numbers in the shortest form that reads back exactly.
[[nodiscard]] std::string toText(const ModuleString& string);

}  // namespace axil::simeco
