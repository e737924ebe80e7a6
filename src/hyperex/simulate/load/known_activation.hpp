// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What a recording tells of an activation. Runs, pictures, pages and Python ask here.

namespace hyperex::simulate {

/// Whether the recording distinguishes an activation from 0: its 95 % interval leaves 0 out.
/// `sigma`: its standard deviation, as MuscleCourse::sigma. False where one is not a number.
bool differs_from_zero(double activation, double sigma);

}  // namespace hyperex::simulate
