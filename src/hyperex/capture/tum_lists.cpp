// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/capture/tum_lists.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "hyperex/core/error.hpp"
#include "hyperex/core/named_file.hpp"
#include "hyperex/io/number.hpp"

namespace hyperex::capture {
namespace {
namespace fs = std::filesystem;

/// Calls use(pictures, line number) for every line, with its `pictures_a_line` pictures.
template <class Use>
void read_lines(const fs::path& file, std::size_t pictures_a_line, const std::string& expected,
                Use use) {
  const std::string text = read_regular_file(file);
  io::Lines lines(text);
  std::string_view line;
  while (lines.next(line)) {
    const auto words = io::words(line);
    if (words.empty() || words.front().starts_with('#')) continue;
    std::vector<ListedPicture> pictures;
    for (std::size_t i = 0; i + 1 < words.size(); i += 2) {
      const auto time_s = io::parse_number(words[i]);
      if (!time_s || !std::isfinite(*time_s)) break;
      pictures.push_back({*time_s, std::string(words[i + 1])});
    }
    if (words.size() != 2 * pictures_a_line || pictures.size() != pictures_a_line)
      throw InputError(InputProblem{file, lines.number(), "", io::quotable(line), expected});
    use(std::move(pictures));
  }
}

}  // namespace

std::vector<ListedPicture> read_picture_list(const fs::path& file) {
  std::vector<ListedPicture> list;
  read_lines(file, 1, "TIME FILE (seconds)",
             [&](std::vector<ListedPicture> line) { list.push_back(std::move(line[0])); });
  return list;
}

std::vector<ListedFrame> read_associations(const fs::path& file) {
  std::vector<ListedFrame> frames;
  read_lines(file, 2, "TIME COLOUR TIME DEPTH (seconds)", [&](std::vector<ListedPicture> line) {
    if (line[0].file.starts_with("depth/") && line[1].file.starts_with("rgb/"))
      std::swap(line[0], line[1]);
    frames.push_back({line[0].time_s, line[0].file, line[1].file, {}});
  });
  return frames;
}

std::vector<ListedFrame> associate(const std::vector<ListedPicture>& colour,
                                   const std::vector<ListedPicture>& depth, double longest_gap_s) {
  std::multimap<double, std::size_t> by_time;
  for (std::size_t j = 0; j < depth.size(); ++j) by_time.emplace(depth[j].time_s, j);
  struct Candidate {
    double gap_s;
    std::size_t colour, depth;
  };
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < colour.size(); ++i) {
    const double time_s = colour[i].time_s;
    for (auto j = by_time.lower_bound(time_s - longest_gap_s);
         j != by_time.end() && j->first <= time_s + longest_gap_s; ++j)
      candidates.push_back({std::abs(j->first - time_s), i, j->second});
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.gap_s < b.gap_s; });
  std::vector<std::optional<std::size_t>> partner(colour.size());
  std::vector<bool> used(depth.size());
  for (const Candidate& c : candidates) {
    if (partner[c.colour] || used[c.depth]) continue;
    partner[c.colour] = c.depth;
    used[c.depth] = true;
  }
  std::vector<ListedFrame> frames;
  for (std::size_t i = 0; i < colour.size(); ++i) {
    ListedFrame frame{colour[i].time_s, colour[i].file, {}, {}};
    if (partner[i])
      frame.depth = depth[*partner[i]].file;
    else
      frame.fault =
          fmt::format("{}: no depth picture within {:g} ms", colour[i].file, 1000 * longest_gap_s);
    frames.push_back(std::move(frame));
  }
  return frames;
}

void add_unpaired(const std::vector<ListedPicture>& listed, std::vector<ListedFrame>& pairs) {
  if (pairs.empty()) return;
  std::set<std::string> paired;
  for (const ListedFrame& frame : pairs) paired.insert(frame.colour);
  std::vector<ListedFrame> frames;
  auto pair = pairs.begin();
  // The order is that of the list. A pair that is not in the list keeps its position among the
  // pairs.
  const std::size_t none = listed.size();
  std::map<std::string, std::size_t> place;
  for (std::size_t i = 0; i < listed.size(); ++i) place.emplace(listed[i].file, i);
  const auto place_of = [&](const ListedFrame& frame) {
    const auto found = place.find(frame.colour);
    return found == place.end() ? none : found->second;
  };
  std::optional<std::size_t> last;
  for (; pair != pairs.end(); ++pair) {
    const std::size_t here = place_of(*pair);
    if (here != none) {
      for (std::size_t i = last ? *last + 1 : here; i < here; ++i)
        if (!paired.contains(listed[i].file))
          frames.push_back({listed[i].time_s,
                            listed[i].file,
                            {},
                            listed[i].file + ": no pair in associations.txt"});
      last = std::max(last.value_or(0), here);
    }
    frames.push_back(std::move(*pair));
  }
  pairs = std::move(frames);
}

void mark_times_going_back(std::vector<ListedFrame>& frames) {
  // Patience sorting: ends[n] is the frame with the earliest time that ends a rising run of n + 1.
  constexpr auto none = static_cast<std::size_t>(-1);
  std::vector<std::size_t> ends, before(frames.size(), none);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (!frames[i].fault.empty()) continue;
    const auto at = std::lower_bound(
        ends.begin(), ends.end(), frames[i].time_s,
        [&](std::size_t end, double time_s) { return frames[end].time_s < time_s; });
    if (at != ends.begin()) before[i] = *std::prev(at);
    if (at == ends.end())
      ends.push_back(i);
    else
      *at = i;
  }
  std::vector<bool> stays(frames.size());
  for (std::size_t i = ends.empty() ? none : ends.back(); i != none; i = before[i]) stays[i] = true;
  for (std::size_t i = 0; i < frames.size(); ++i)
    if (!stays[i] && frames[i].fault.empty())
      frames[i].fault = fmt::format("{}: its time {:.6f} s is out of order (time must rise)",
                                    frames[i].colour, frames[i].time_s);
}

}  // namespace hyperex::capture
