// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Remarks of a call besides its result and its errors, such as that a texture is missing and the
// scan is read without it. Libraries print nothing: a program that wants the remarks registers a
// listener.
#include <functional>
#include <string>

namespace hyperex {

enum class Remark { note, warning };
using RemarkListener = std::function<void(Remark kind, const std::string& sentence)>;

/// Replaces the listener. Empty, as at the start: remarks are dropped. It is called on the thread
/// that makes the remark, possibly on several at a time, and must not throw.
void listen_to_remarks(RemarkListener listener);

void remark(Remark kind, const std::string& sentence);

}  // namespace hyperex
