// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace CLI {
class App;
}

/// `hyperex scene-reference`, hidden: prints docs/scene.md.
void add_scene_reference(CLI::App& app);
