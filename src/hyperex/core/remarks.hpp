// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What a call has to say besides its result and its errors: a sentence, such as that a texture is
// missing and the scan is read without it. Libraries print nothing: a program that wants to know
// listens.
#include <functional>
#include <string>

namespace hyperex {

enum class Remark { note, warning };
using RemarkListener = std::function<void(Remark kind, const std::string& sentence)>;

/// Takes the place of the listener before; an empty one: nobody listens, as at the start. Called
/// on the thread that has something to say, by several at a time; must not throw.
void listen_to_remarks(RemarkListener listener);

void remark(Remark kind, const std::string& sentence);

}  // namespace hyperex
