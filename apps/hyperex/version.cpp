// SPDX-License-Identifier: GPL-3.0-or-later
// The output of --version: the release, its commit, and the libraries on which the program's
// results depend.
#include "hyperex/core/version.hpp"

#include <cholmod.h>
#include <embree3/rtcore.h>
#include <fmt/format.h>
#include <spdlog/version.h>
#include <tbb/version.h>

#include <Eigen/Core>
#include <boost/version.hpp>
#include <opencv2/core/utility.hpp>

#include "commands.hpp"

// The header's folder differs between builds of OpenBLAS.
extern "C" char* openblas_get_config(void);

namespace {

std::string embree() {
  RTCDevice device = rtcNewDevice(nullptr);
  if (!device) return "not usable here";
  const auto part = [&](RTCDeviceProperty which) { return rtcGetDeviceProperty(device, which); };
  const std::string text =
      fmt::format("{}.{}.{}", part(RTC_DEVICE_PROPERTY_VERSION_MAJOR),
                  part(RTC_DEVICE_PROPERTY_VERSION_MINOR), part(RTC_DEVICE_PROPERTY_VERSION_PATCH));
  rtcReleaseDevice(device);
  return text;
}

std::string cholmod() {
  int version[3];
  cholmod_version(version);
  return fmt::format("{}.{}.{}", version[0], version[1], version[2]);
}

// Decodes a version number with two decimal digits per part: 90100 is 9.1.0.
std::string of_decimal(int number, int step) {
  return fmt::format("{}.{}.{}", number / (step * step), number / step % step, number % step);
}

}  // namespace

namespace hyperex::cli {

std::string version_text() {
  std::string text = fmt::format("hyperex {}", hyperex::version());
  if (!hyperex::commit().empty()) text += fmt::format(" (commit {})", hyperex::commit());
  text += fmt::format("\nCompiled by {} with Eigen {}.{}.{}, Boost {}.{}.{}",
#ifdef __clang__
                      "Clang " __clang_version__,
#else
                      "GCC " __VERSION__,
#endif
                      EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION,
                      BOOST_VERSION / 100000, BOOST_VERSION / 100 % 1000, BOOST_VERSION % 100);
  text += fmt::format(
      "\nRuns with CHOLMOD {}, {}, oneTBB {}, Embree {}, OpenCV {}, fmt {}, spdlog {}.{}.{}\n",
      cholmod(), openblas_get_config(), TBB_runtime_version(), embree(), cv::getVersionString(),
      of_decimal(FMT_VERSION, 100), SPDLOG_VER_MAJOR, SPDLOG_VER_MINOR, SPDLOG_VER_PATCH);
  text += "Licence: GPL-3.0-or-later. There is no warranty.";
  return text;
}

}  // namespace hyperex::cli
