// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A list whose copies share their elements until one of them is changed.
#pragma once

#include <initializer_list>
#include <memory>
#include <utility>
#include <vector>

namespace tooljoint::model {

/// A value like std::vector that costs a pointer to copy: a hundred identical reduced parts hold
/// one list of matrix terms. It is read as `const std::vector<T>&`; a changed copy has its own
/// elements.
template <class T>
class SharedList {
 public:
  using value_type = T;
  using const_iterator = typename std::vector<T>::const_iterator;

  SharedList() = default;
  SharedList(std::vector<T> items) : items_(std::make_shared<std::vector<T>>(std::move(items))) {}
  SharedList(std::initializer_list<T> items) : SharedList(std::vector<T>(items)) {}

  operator const std::vector<T>&() const { return items(); }
  const_iterator begin() const { return items().begin(); }
  const_iterator end() const { return items().end(); }
  std::size_t size() const { return items().size(); }
  bool empty() const { return items().empty(); }
  const T& operator[](std::size_t i) const { return items()[i]; }
  const T& at(std::size_t i) const { return items().at(i); }
  const T& front() const { return items().front(); }
  const T& back() const { return items().back(); }

  void push_back(T item) { own().push_back(std::move(item)); }
  void clear() { items_.reset(); }
  /// The elements for writing, until this list is copied.
  std::vector<T>& own() {
    if (!items_ || items_.use_count() > 1) items_ = std::make_shared<std::vector<T>>(items());
    return *items_;
  }

  friend bool operator==(const SharedList& a, const SharedList& b) {
    return a.items_ == b.items_ || a.items() == b.items();
  }
  friend bool operator!=(const SharedList& a, const SharedList& b) { return !(a == b); }

 private:
  const std::vector<T>& items() const {
    static const std::vector<T> none;
    return items_ ? *items_ : none;
  }

  std::shared_ptr<std::vector<T>> items_;  ///< null: empty
};

}  // namespace tooljoint::model
