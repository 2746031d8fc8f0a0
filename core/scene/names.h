#pragma once
// Names that are defined within blocks.

#include <cstddef>
#include <deque>
#include <string>
#include <unordered_map>
#include <vector>

namespace pbrt {

// A definition with a name. Those that can be seen at a place are the last one, the one before it,
// and so on: blocks make a tree of them.
template <class T>
struct Named {
  std::string name;
  T value;
  Named* before = nullptr;
  std::size_t depth = 0;  // how many come before
  Named* jump = nullptr;  // one far before: jumps double in length (Myers 1983, "An applicative
                          // random-access stack"), so that any is reached in O(log depth)

  // The one that has `wanted` before it; wanted <= depth.
  Named* at(std::size_t wanted) {
    Named* node = this;
    while (node->depth > wanted) node = node->jump->depth >= wanted ? node->jump : node->before;
    return node;
  }
};

// All definitions of a kind.
template <class T>
class NamedList {
 public:
  // Adds one after `last`, which becomes it.
  void add(Named<T>*& last, const std::string& name, T value) {
    Named<T>& node = all_.emplace_back();
    node.name = name;
    node.value = std::move(value);
    node.before = node.jump = last;
    if (last) {
      node.depth = last->depth + 1;
      const Named<T>* const middle = last->jump;
      if (middle && middle->jump &&
          last->depth - middle->depth == middle->depth - middle->jump->depth)
        node.jump = middle->jump;
    }
    byName_[name].push_back(&node);
    last = &node;
  }
  // The latest of this name among `last` and those before it; null if there is none.
  Named<T>* find(Named<T>* last, const std::string& name) const {
    const auto found = byName_.find(name);
    if (!last || found == byName_.end()) return nullptr;
    for (auto node = found->second.rbegin(); node != found->second.rend(); ++node)
      if ((*node)->depth <= last->depth && last->at((*node)->depth) == *node) return *node;
    return nullptr;
  }

 private:
  std::deque<Named<T>> all_;  // addresses stay valid
  std::unordered_map<std::string, std::vector<Named<T>*>> byName_;
};

}  // namespace pbrt
