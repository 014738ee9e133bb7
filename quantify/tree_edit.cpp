#include "quantify/tree_edit.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

namespace axil::quantify {

namespace {

/// Segments as a tree under one root that stands for the collar; children before parents.
struct Tree {
  std::vector<std::vector<std::size_t>> children;  ///< place n is the root
  std::vector<int> kind;                           ///< 0: goes on, 1: branches off, 2: the root
  std::vector<std::int32_t> size;                  ///< segments in the subtree
};

Tree treeOf(const Measurements& m) {
  const std::size_t n = m.segments.size();
  Tree tree{std::vector<std::vector<std::size_t>>(n + 1), std::vector<int>(n + 1, 2), std::vector<std::int32_t>(n + 1, 1)};
  // Segments come parent before child, so counted from the end they come after their children.
  for (std::size_t s = 0; s < n; ++s) {
    const std::size_t place = n - 1 - s;
    tree.kind[place] = m.segments[s].kind == SegmentKind::Branch ? 1 : 0;
    const std::size_t parent = m.segments[s].parent ? n - 1 - static_cast<std::size_t>(m.segments[s].parent->value) : n;
    tree.children[parent].push_back(place);
  }
  for (std::size_t i = 0; i <= n; ++i)
    for (const std::size_t child : tree.children[i]) tree.size[i] += tree.size[child];
  return tree;
}

/// The cheapest assignment of rows to columns of a square matrix (Hungarian method with potentials).
std::int32_t cheapestAssignment(const std::vector<std::vector<std::int32_t>>& cost) {
  const std::size_t n = cost.size();
  constexpr std::int32_t kMost = std::numeric_limits<std::int32_t>::max() / 4;
  std::vector<std::int32_t> u(n + 1, 0), v(n + 1, 0);
  std::vector<std::size_t> row(n + 1, 0), way(n + 1, 0);
  for (std::size_t i = 1; i <= n; ++i) {
    row[0] = i;
    std::size_t column = 0;
    std::vector<std::int32_t> least(n + 1, kMost);
    std::vector<bool> used(n + 1, false);
    do {
      used[column] = true;
      const std::size_t r = row[column];
      std::int32_t delta = kMost;
      std::size_t next = 0;
      for (std::size_t j = 1; j <= n; ++j) {
        if (used[j]) continue;
        const std::int32_t reduced = cost[r - 1][j - 1] - u[r] - v[j];
        if (reduced < least[j]) least[j] = reduced, way[j] = column;
        if (least[j] < delta) delta = least[j], next = j;
      }
      for (std::size_t j = 0; j <= n; ++j) {
        if (used[j]) u[row[j]] += delta, v[j] -= delta;
        else least[j] -= delta;
      }
      column = next;
    } while (row[column] != 0);
    do {
      const std::size_t before = way[column];
      row[column] = row[before];
      column = before;
    } while (column != 0);
  }
  return -v[0];
}

class Editor {
 public:
  Editor(Tree a, Tree b) : a_(std::move(a)), b_(std::move(b)), tree_(a_.kind.size() * b_.kind.size()), forest_(tree_.size()) {}

  std::int32_t distance() {
    for (std::size_t i = 0; i < a_.kind.size(); ++i)
      for (std::size_t j = 0; j < b_.kind.size(); ++j) {
        forest(i, j) = forestDistance(i, j);
        tree(i, j) = treeDistance(i, j);
      }
    return tree(a_.kind.size() - 1, b_.kind.size() - 1);
  }

 private:
  std::int32_t& tree(std::size_t i, std::size_t j) { return tree_[i * b_.kind.size() + j]; }
  std::int32_t& forest(std::size_t i, std::size_t j) { return forest_[i * b_.kind.size() + j]; }

  /// Of the subtrees: one root is inserted above the other tree, or the roots are the same.
  std::int32_t treeDistance(std::size_t i, std::size_t j) {
    std::int32_t best = forest(i, j) + (a_.kind[i] == b_.kind[j] ? 0 : 1);
    for (const std::size_t child : b_.children[j]) best = std::min(best, b_.size[j] - b_.size[child] + tree(i, child));
    for (const std::size_t child : a_.children[i]) best = std::min(best, a_.size[i] - a_.size[child] + tree(child, j));
    return best;
  }
  /// Of what hangs below i and j.
  std::int32_t forestDistance(std::size_t i, std::size_t j) {
    const auto& x = a_.children[i];
    const auto& y = b_.children[j];
    if (x.empty()) return b_.size[j] - 1;
    if (y.empty()) return a_.size[i] - 1;
    std::int32_t best = assignment(x, y);
    for (const std::size_t child : y) best = std::min(best, b_.size[j] - b_.size[child] + forest(i, child));
    for (const std::size_t child : x) best = std::min(best, a_.size[i] - a_.size[child] + forest(child, j));
    return best;
  }
  /// Children are paired, or deleted, or inserted.
  std::int32_t assignment(const std::vector<std::size_t>& x, const std::vector<std::size_t>& y) {
    if (x.size() == 1 && y.size() == 1) return std::min(tree(x[0], y[0]), a_.size[x[0]] + b_.size[y[0]]);
    const std::size_t n = x.size() + y.size();
    constexpr std::int32_t kNever = 1 << 28;
    std::vector<std::vector<std::int32_t>> cost(n, std::vector<std::int32_t>(n, 0));
    for (std::size_t r = 0; r < n; ++r)
      for (std::size_t c = 0; c < n; ++c) {
        if (r < x.size() && c < y.size()) cost[r][c] = tree(x[r], y[c]);
        else if (r < x.size()) cost[r][c] = c - y.size() == r ? a_.size[x[r]] : kNever;
        else if (c < y.size()) cost[r][c] = r - x.size() == c ? b_.size[y[c]] : kNever;
      }
    return cheapestAssignment(cost);
  }

  Tree a_, b_;
  std::vector<std::int32_t> tree_, forest_;
};

}  // namespace

std::size_t treeEditDistance(const Measurements& a, const Measurements& b) { return static_cast<std::size_t>(Editor(treeOf(a), treeOf(b)).distance()); }

}  // namespace axil::quantify
