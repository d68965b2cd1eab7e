// A list whose copies share memory until one of them is edited: bricks share their faces, a scene and its model share shapes.
#pragma once
#include <cstddef>
#include <initializer_list>
#include <memory>
#include <utility>
#include <vector>

namespace erbs {

template <class T>
class Shared {
 public:
  using List = std::vector<T>;
  using value_type = T;

  Shared() = default;
  Shared(List list) : list_(std::make_shared<List>(std::move(list))) {}
  Shared(std::initializer_list<T> list) : Shared(List(list)) {}

  const List& list() const {
    static const List none;
    return list_ ? *list_ : none;
  }
  operator const List&() const { return list(); }
  List& edit() {  // detaches this copy from the others first
    if (!list_ || list_.use_count() > 1) list_ = std::make_shared<List>(list());
    return *list_;
  }
  void push_back(T item) { edit().push_back(std::move(item)); }

  std::size_t size() const { return list().size(); }
  bool empty() const { return list().empty(); }
  const T& operator[](std::size_t i) const { return list()[i]; }
  const T& at(std::size_t i) const { return list().at(i); }
  typename List::const_iterator begin() const { return list().begin(); }
  typename List::const_iterator end() const { return list().end(); }
  friend bool operator==(const Shared& a, const Shared& b) { return a.list() == b.list(); }

 private:
  std::shared_ptr<List> list_;
};

}  // namespace erbs
