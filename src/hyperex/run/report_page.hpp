// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "hyperex/report/html_report.hpp"
#include "hyperex/run/outputs.hpp"
#include "hyperex/session/variants.hpp"

namespace hyperex::run {
using session::VariantRun;

/// The contents of the page of a run and its variants. The referenced objects must outlive it.
class ReplayPage {
 public:
  ReplayPage(const Results& results, const std::vector<VariantRun>& variants,
             nlohmann::json summary);
  const report::ReportInput& input() const { return input_; }

 private:
  report::ReportInput input_;
};

/// Writes report.html: the face in motion, its variants, curves, and the summary as tables.
void write_report(const Results& results, const std::vector<VariantRun>& variants,
                  const nlohmann::ordered_json& summary, const std::filesystem::path& directory);

/// The changes of a variant in words, one per key: "tissue.young_kpa = 1000", "tissue.region: name
/// = cheek_R, young_factor = 10".
std::vector<std::string> change_texts(const nlohmann::json& changes);

}  // namespace hyperex::run
