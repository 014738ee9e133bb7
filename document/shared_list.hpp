#pragma once
/// \file
/// SharedList<T> and SharedText: values that are copied for the price of a pointer and share what they have in common, so
/// that ten thousand states of a project fit where ten would. They behave as std::vector<T> and std::string would: a copy
/// never sees what is done to another. Elements are read in place and replaced whole.

#include <algorithm>
#include <atomic>
#include <compare>
#include <cstddef>
#include <initializer_list>
#include <iterator>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace axil::document {

/// A list in pages of 32 elements. Replacing one element copies one page of pointers and the list of pages, never elements;
/// erasing also moves what comes after. Reading from several threads is fine; writing needs a copy of one's own.
template <class T>
class SharedList {
 public:
  using value_type = T;

  class const_iterator {
   public:
    using iterator_category = std::random_access_iterator_tag;
    using value_type = T;
    using difference_type = std::ptrdiff_t;
    using pointer = const T*;
    using reference = const T&;

    const_iterator() = default;
    const_iterator(const SharedList* list, std::size_t at) : list_(list), at_(at) {}

    reference operator*() const { return (*list_)[at_]; }
    pointer operator->() const { return &(*list_)[at_]; }
    reference operator[](difference_type by) const { return *(*this + by); }
    const_iterator& operator+=(difference_type by) {
      at_ = static_cast<std::size_t>(static_cast<difference_type>(at_) + by);
      return *this;
    }
    const_iterator& operator-=(difference_type by) { return *this += -by; }
    const_iterator& operator++() { return *this += 1; }
    const_iterator& operator--() { return *this += -1; }
    const_iterator operator++(int) { return std::exchange(*this, *this + 1); }
    const_iterator operator--(int) { return std::exchange(*this, *this - 1); }
    friend const_iterator operator+(const_iterator it, difference_type by) { return it += by; }
    friend const_iterator operator+(difference_type by, const_iterator it) { return it += by; }
    friend const_iterator operator-(const_iterator it, difference_type by) { return it -= by; }
    friend difference_type operator-(const_iterator a, const_iterator b) {
      return static_cast<difference_type>(a.at_) - static_cast<difference_type>(b.at_);
    }
    friend bool operator==(const_iterator a, const_iterator b) { return a.at_ == b.at_; }
    friend std::strong_ordering operator<=>(const_iterator a, const_iterator b) { return a.at_ <=> b.at_; }

   private:
    const SharedList* list_ = nullptr;
    std::size_t at_ = 0;
  };

  SharedList() = default;
  SharedList(std::initializer_list<T> elements) {
    for (const T& element : elements) push_back(element);
  }

  [[nodiscard]] std::size_t size() const { return pages_ ? (pages_->size() - 1) * kPage + pages_->back()->size() : 0; }
  [[nodiscard]] bool empty() const { return pages_ == nullptr; }
  [[nodiscard]] const T& operator[](std::size_t i) const { return *(*(*pages_)[i / kPage])[i % kPage]; }
  [[nodiscard]] const T& front() const { return (*this)[0]; }
  [[nodiscard]] const T& back() const { return (*this)[size() - 1]; }
  [[nodiscard]] const_iterator begin() const { return {this, 0}; }
  [[nodiscard]] const_iterator end() const { return {this, size()}; }

  void push_back(T element) { pushShared(std::make_shared<const T>(std::move(element))); }
  void set(std::size_t i, T element) { ownPage(i / kPage)[i % kPage] = std::make_shared<const T>(std::move(element)); }
  void erase(std::size_t i) {
    for (std::size_t p = i / kPage; p < pages_->size(); ++p) {
      Page& page = ownPage(p);
      page.erase(page.begin() + static_cast<std::ptrdiff_t>(p == i / kPage ? i % kPage : 0));
      if (p + 1 < pages_->size()) page.push_back((*pages_)[p + 1]->front());
    }
    if (pages_->back()->empty()) ownPages().pop_back();
    if (pages_->empty()) pages_.reset();
  }
  /// Leaves out every element that `is`; those that stay are shared, not copied.
  template <class Is>
  void eraseIf(Is is) {
    if (std::none_of(begin(), end(), is)) return;
    SharedList kept;
    for (std::size_t i = 0; i < size(); ++i)
      if (!is((*this)[i])) kept.pushShared((*(*pages_)[i / kPage])[i % kPage]);
    *this = std::move(kept);
  }

  /// Whether both are the very same storage: equal without a look at the elements.
  [[nodiscard]] bool sharesAllWith(const SharedList& other) const { return pages_ == other.pages_; }

  friend bool operator==(const SharedList& a, const SharedList& b) {
    if (a.pages_ == b.pages_) return true;
    if (a.size() != b.size()) return false;
    for (std::size_t p = 0; p < a.pages_->size(); ++p)
      if ((*a.pages_)[p] != (*b.pages_)[p] && !equalPages(*(*a.pages_)[p], *(*b.pages_)[p])) return false;
    return true;
  }

 private:
  static constexpr std::size_t kPage = 32;
  using Page = std::vector<std::shared_ptr<const T>>;  // never empty inside pages_, full in all but the last
  using Pages = std::vector<std::shared_ptr<Page>>;

  void pushShared(std::shared_ptr<const T> element) {
    if (size() % kPage == 0) ownPages().push_back(std::make_shared<Page>());
    ownPage(pages_->size() - 1).push_back(std::move(element));
  }
  static bool equalPages(const Page& a, const Page& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) { return x == y || *x == *y; });
  }

  // Nobody else can begin to look at what only we hold; the fence orders us after whoever let go of it last.
  template <class P>
  static bool isOurs(const std::shared_ptr<P>& p) {
    if (p.use_count() != 1) return false;
    std::atomic_thread_fence(std::memory_order_acquire);
    return true;
  }
  Pages& ownPages() {
    if (!pages_) pages_ = std::make_shared<Pages>();
    else if (!isOurs(pages_)) pages_ = std::make_shared<Pages>(*pages_);
    return *pages_;
  }
  Page& ownPage(std::size_t p) {
    std::shared_ptr<Page>& page = ownPages()[p];
    if (!isOurs(page)) page = std::make_shared<Page>(*page);
    return *page;
  }

  std::shared_ptr<Pages> pages_;  // null: empty
};

/// A text that its copies share.
class SharedText {
 public:
  SharedText() = default;
  SharedText(std::string text) : text_(text.empty() ? nullptr : std::make_shared<const std::string>(std::move(text))) {}
  SharedText(std::string_view text) : SharedText(std::string(text)) {}
  SharedText(const char* text) : SharedText(std::string(text)) {}

  [[nodiscard]] const std::string& text() const { return text_ ? *text_ : kEmpty; }
  operator std::string_view() const { return text(); }
  [[nodiscard]] bool empty() const { return text_ == nullptr; }
  [[nodiscard]] std::size_t size() const { return text().size(); }

  friend bool operator==(const SharedText& a, const SharedText& b) { return a.text_ == b.text_ || a.text() == b.text(); }

 private:
  inline static const std::string kEmpty = {};
  std::shared_ptr<const std::string> text_;
};

}  // namespace axil::document
