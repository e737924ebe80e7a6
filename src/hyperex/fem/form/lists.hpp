// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <algorithm>
#include <span>
#include <vector>

namespace hyperex::fem {

/// Lists of integers stored consecutively: list i is item[start[i]] ... item[start[i + 1] - 1].
struct Lists {
  std::vector<int> start{0}, item;

  int size() const { return static_cast<int>(start.size()) - 1; }
  std::span<const int> operator[](int i) const {
    return {item.data() + start[i], static_cast<std::size_t>(start[i + 1] - start[i])};
  }
  void append(std::span<const int> list) {
    item.insert(item.end(), list.begin(), list.end());
    start.push_back(static_cast<int>(item.size()));
  }
};

/// For each of 0 ... count-1, the numbers of the lists that contain it, increasing.
inline Lists transposed(const Lists& lists, int count) {
  Lists out;
  out.start.assign(count + 1, 0);
  for (const int i : lists.item) ++out.start[i + 1];
  for (int i = 0; i < count; ++i) out.start[i + 1] += out.start[i];
  out.item.resize(lists.item.size());
  std::vector<int> next(out.start.begin(), out.start.end() - 1);
  for (int k = 0; k < lists.size(); ++k)
    for (const int i : lists[k]) out.item[next[i]++] = k;
  return out;
}

/// List i of the result is the union of the lists of `second` whose numbers are in list i of
/// `first`, increasing and without duplicates.
inline Lists joined(const Lists& first, const Lists& second) {
  Lists out;
  out.start.reserve(first.start.size());
  std::vector<int> list;
  for (int i = 0; i < first.size(); ++i) {
    list.clear();
    for (const int k : first[i]) list.insert(list.end(), second[k].begin(), second[k].end());
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    out.append(list);
  }
  return out;
}

}  // namespace hyperex::fem
