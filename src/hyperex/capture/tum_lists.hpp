// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace hyperex::capture {

/// One line of rgb.txt or depth.txt: "TIME FILE". TIME is in seconds; FILE is relative to the
/// folder.
struct ListedPicture {
  double time_s = 0;
  std::string file;
};

/// One frame of a folder before its pictures are read.
struct ListedFrame {
  double time_s = 0;          ///< of the colour picture
  std::string colour, depth;  ///< relative to the folder; depth is empty where there is none
  /// One line; set if the frame is known to be faulty before its pictures are read.
  std::string fault;
};

/// Reads a list in the TUM RGB-D layout: words separated by blanks; # begins a comment. Throws
/// InputError naming the line if it is not "TIME FILE" with a finite time.
std::vector<ListedPicture> read_picture_list(const std::filesystem::path& file);

/// Reads associations.txt: "TIME COLOUR TIME DEPTH". Some tools write depth first; this is
/// recognised by the folder names rgb/ and depth/. Throws as read_picture_list() does.
std::vector<ListedFrame> read_associations(const std::filesystem::path& file);

/// Pairs every colour picture with the depth picture nearest in time. The nearest pairs are formed
/// first, each picture is used once, and no pair is farther apart than `longest_gap_s`. This is the
/// rule of TUM's own tool. A colour picture without a pair gets a fault.
std::vector<ListedFrame> associate(const std::vector<ListedPicture>& colour,
                                   const std::vector<ListedPicture>& depth,
                                   double longest_gap_s = 0.02);

/// Inserts the colour pictures of `listed` that are in no pair but lie between the first and the
/// last pair, each with a fault. So a missing pair gives a faulty frame, not a shorter recording.
void add_unpaired(const std::vector<ListedPicture>& listed, std::vector<ListedFrame>& pairs);

/// Marks frames whose times are not in increasing order. A longest increasing subsequence of the
/// frames without a fault is kept, so that one wrong time, early or late, invalidates one frame
/// only. All other frames get a fault.
void mark_times_going_back(std::vector<ListedFrame>& frames);

}  // namespace hyperex::capture
