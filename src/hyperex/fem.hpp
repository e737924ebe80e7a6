// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The solver alone, for any body of tetrahedra (docs/library.md): hyperex::fem links no faces.
#include "hyperex/core/error.hpp"
#include "hyperex/fem/form/assembler.hpp"
#include "hyperex/fem/form/inverted.hpp"
#include "hyperex/fem/form/system.hpp"
#include "hyperex/fem/reduced/reduced_model.hpp"
#include "hyperex/fem/solve/static_solve.hpp"
#include "hyperex/fem/time/finite_newton.hpp"
#include "hyperex/fem/time/newmark.hpp"
