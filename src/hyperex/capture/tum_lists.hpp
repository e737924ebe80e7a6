// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace hyperex::capture {

/// One line of rgb.txt or depth.txt: "TIME FILE", seconds, the file relative to the folder.
struct ListedPicture {
  double time_s = 0;
  std::string file;
};

/// One frame of a folder before its pictures are read.
struct ListedFrame {
  double time_s = 0;          ///< of the colour picture
  std::string colour, depth;  ///< relative to the folder; depth is empty where there is none
  std::string fault;          ///< one line, where it is known already that the frame is no good
};

/// Lists of the TUM RGB-D layout: lines of words, # begins a comment.
/// Throws InputError naming the line where it is not "TIME FILE" with a finite time.
std::vector<ListedPicture> read_picture_list(const std::filesystem::path& file);

/// associations.txt: "TIME COLOUR TIME DEPTH" or, as some tools write it, depth first:
/// distinguished by the folders' names rgb/ and depth/. Same errors.
std::vector<ListedFrame> read_associations(const std::filesystem::path& file);

/// Pairs every colour picture with the depth picture nearest in time, nearest pairs first, each
/// used once and no pair further apart than `longest_gap_s` (the rule of TUM's own tool). A colour
/// picture left over gets a fault.
std::vector<ListedFrame> associate(const std::vector<ListedPicture>& colour,
                                   const std::vector<ListedPicture>& depth,
                                   double longest_gap_s = 0.02);

/// Colour pictures of `listed` between the first and the last frame of `pairs`, but in none, come
/// among them, with a fault: a missing pair leaves a faulty frame, not a shorter recording.
void add_unpaired(const std::vector<ListedPicture>& listed, std::vector<ListedFrame>& pairs);

/// Time must rise: a longest rising subsequence of the frames without a fault stays, so that one
/// wrong time, early or late, costs one frame; the others get a fault.
void mark_times_going_back(std::vector<ListedFrame>& frames);

}  // namespace hyperex::capture
