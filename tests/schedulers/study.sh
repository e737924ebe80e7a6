# SPDX-License-Identifier: GPL-3.0-or-later
# Sourced by the tests: a study of three cases in $work, and what must come of it. $hyperex is the
# program.
said() { echo "$*"; exit 1; }

write_study() {  # STIFF PART OF THE LAST CASE
  mkdir -p "$work/my study"
  cat > "$work/my study/base.toml" << 'END'
scan = { file = "embedded" }
motion = { file = "embedded" }
END
  cat > "$work/my study/study.toml" << END
scene = "base.toml"
out = "out"
set = { mesh.element_size_mm = 9, motion.time_scale = 0.1, output.vtu = false, output.glb = false, output.report = false, output.picture_times_s = [0] }
[[grid.case]]
name = "first"
[[grid.case]]
name = "second"
tissue.viscosity_pa_s = 5000
[[grid.case]]
name = "third"
tissue.region = [{ $1, young_factor = 2 }]
END
  cd "$work"
}
# What only a run finds: the place lies half a metre beside the face.
broken='scar_points_mm = [[500, 0, 0], [510, 0, 0]]'
sound='name = "cheek_R"'

states() { cut -d, -f1,2 "$work/my study/out/study.csv" | tail -n +2 | tr '\n' ' '; }

expect_two_of_three() {
  [[ "$(states)" == "first,finished second,finished third,failed " ]] || said "the table: $(states)"
  grep -q 'third.*scar_points_mm' "$work/my study/out/study.csv" || said "the table does not say why"
}

all_three="first,finished second,finished third,finished "
written() { stat -c %y "$work/my study/out/cases/first-"*/summary.json; }
