// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/study/scheduler_scripts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "hyperex/study/child.hpp"

namespace hyperex::study {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kTasksInAnArray = 1000;  // Slurm's MaxArraySize is 1001 by default

/// A string literal of Python.
std::string python_text(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
}

/// The name of a job; it has no blanks.
std::string job_name(const fs::path& study) {
  std::string name = study.stem().string();
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != '.') c = '_';
  return name;
}

/// A path in an #SBATCH line; % is escaped, since it begins a pattern.
std::string sbatch_path(const fs::path& path) {
  std::string text;
  for (const char c : path.string()) {
    if (c == '%') text += '%';
    if (c == '"' || c == '\\') text += '\\';
    text += c;
  }
  return text;
}

std::string call_of(const Called& called) {
  return quoted_for_shell(called.program.string()) + " sweep " +
         quoted_for_shell(called.study.string()) + " --out " +
         quoted_for_shell(called.out.string());
}

}  // namespace

std::string slurm_script(const Called& called, std::size_t cases) {
  const std::string name = job_name(called.study), call = call_of(called);
  std::string text = fmt::format(
      "#!/bin/bash\n"
      "# {} cases, each a task of a job array of Slurm, and a job that makes the table from them.\n"
      "# Run this script with bash where jobs are submitted. Lines of #SBATCH for partition, time\n"
      "# and memory may be added, or given as SBATCH_PARTITION, SBATCH_TIMELIMIT and so on.\n"
      "set -euo pipefail\n"
      "mkdir -p {}\n"
      "jobs=\n",
      cases, quoted_for_shell((called.out / "logs").string()));
  for (std::size_t begin = 0; begin < cases; begin += kTasksInAnArray)
    text += fmt::format(
        "job=$(sbatch --parsable <<'END'\n"
        "#!/bin/bash\n"
        "#SBATCH --job-name={}\n"
        "#SBATCH --array=1-{}\n"
        "#SBATCH --ntasks=1\n"
        "#SBATCH --cpus-per-task=1\n"
        "#SBATCH --output=\"{}/slurm-%A_%a.txt\"\n"
        "exec {} --case $((SLURM_ARRAY_TASK_ID + {}))\n"
        "END\n"
        ")\n"
        "jobs=$jobs:${{job%%;*}}\n",
        name, std::min(kTasksInAnArray, cases - begin), sbatch_path(called.out / "logs"), call,
        begin);
  return text + fmt::format(
                    "sbatch --dependency=afterany\"$jobs\" <<'END'\n"
                    "#!/bin/bash\n"
                    "#SBATCH --job-name={}-table\n"
                    "#SBATCH --output=\"{}/slurm-table-%j.txt\"\n"
                    "exec {} --collect\n"
                    "END\n",
                    name, sbatch_path(called.out / "logs"), call);
}

std::string snakefile(const Called& called, const std::vector<PlannedCase>& planned) {
  std::string text = fmt::format(
      "# {} cases, a job each, and the table made from them. Run it with\n"
      "#   snakemake --snakefile THIS_FILE --cores all --keep-going\n"
      "# Cases are known by a hash of their inputs: print it again when an input has changed.\n"
      "PROGRAM = {}\n"
      "STUDY = {}\n"
      "OUT = {}\n"
      "FOLDER = OUT.replace(\"{{\", \"{{{{\").replace(\"}}\", \"}}}}\") + \"/cases/{{case}}\"\n"
      "CASES = [\n",
      planned.size(), python_text(called.program.string()), python_text(called.study.string()),
      python_text(called.out.string()));
  for (const PlannedCase& one : planned)
    text += "    " + python_text(one.files.folder.filename().string()) + ",\n";
  return text +
         "]\n"
         "\n"
         // The folders are inputs too: otherwise Snakemake would accept an outdated table.
         "rule all:\n"
         "    input:\n"
         "        expand(FOLDER, case=CASES),\n"
         "        OUT + \"/study.csv\",\n"
         "\n"
         "rule table:\n"
         "    input:\n"
         "        expand(FOLDER, case=CASES),\n"
         "    output:\n"
         "        OUT + \"/study.csv\",\n"
         "    shell:\n"
         "        \"{PROGRAM:q} sweep {STUDY:q} --out {OUT:q} --collect\"\n"
         "\n"
         "rule case:\n"
         "    output:\n"
         "        directory(FOLDER),\n"
         "    shell:\n"
         "        \"{PROGRAM:q} sweep {STUDY:q} --out {OUT:q} --case {wildcards.case:q}\"\n"
         "\n"
         "onerror:\n"
         "    shell(\"{PROGRAM:q} sweep {STUDY:q} --out {OUT:q} --collect\")\n";
}

}  // namespace hyperex::study
