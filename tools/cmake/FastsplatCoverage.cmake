# The RTL with line coverage and cover points. Built only for the program that closes coverage (`tools/coverage`).
#   tiny      the smallest named configuration
#   mustfail  adds rounded centres, two radius sets, early termination
#   westover  adds compositing of every sample
#   cull      adds occlusion culling
#   post      adds weights between entries of the radial table, densities classified by pixel
set(FASTSPLAT_COVERED_CONFIGS tiny mustfail westover cull post)
set(declarations "")
set(entries "")
add_library(fastsplat_covered_rtl STATIC EXCLUDE_FROM_ALL)
target_link_libraries(fastsplat_covered_rtl PUBLIC fastsplat_testbench)
target_compile_definitions(fastsplat_covered_rtl PRIVATE VM_COVERAGE=1)
foreach(config ${FASTSPLAT_COVERED_CONFIGS})
  set(file ${PROJECT_SOURCE_DIR}/configs/${config}.toml)
  if(NOT EXISTS ${file})
    set(file ${PROJECT_SOURCE_DIR}/configs/faults/${config}.toml)
  endif()
  fastsplat_verilate(covered_${config} ${file} ASSERT ARGS --coverage-line --coverage-user)
  string(APPEND declarations "std::unique_ptr<RtlDevice> make_covered_${config}(const cmodel::Config&, cmodel::PixelSink&, const RtlOptions&, const CoverageDat&);\n")
  string(APPEND entries "    {\"${config}\", make_covered_${config}},\n")
  set(source ${PROJECT_BINARY_DIR}/generated/testbench/covered_${config}.cpp)
  file(CONFIGURE OUTPUT ${source} @ONLY CONTENT [=[
// Generated; do not edit.
#include "Vfs_covered_@config@.h"
#include "testbench/device/covered_device.hpp"
#include "testbench/device/verilated_device.hpp"
#include "testbench/module/verilated_top.hpp"

namespace fastsplat::testbench {
std::unique_ptr<RtlDevice> make_covered_@config@(const cmodel::Config& config, cmodel::PixelSink& pixels, const RtlOptions& options, const CoverageDat& dat) {
  return make_covered_device(std::make_unique<VerilatedTop<Vfs_covered_@config@>>(simulator_options(options)), config, pixels, options, dat);
}
}  // namespace fastsplat::testbench
]=])
  target_sources(fastsplat_covered_rtl PRIVATE ${source})
  target_link_libraries(fastsplat_covered_rtl PUBLIC covered_${config})
endforeach()
set(registry ${PROJECT_BINARY_DIR}/generated/testbench/covered_registry.cpp)
file(CONFIGURE OUTPUT ${registry} @ONLY CONTENT [=[
// Generated; do not edit.
#include "testbench/device/covered_registry.hpp"

namespace fastsplat::testbench {
@declarations@
namespace {
constexpr CoveredEntry kEntries[] = {
@entries@};
}  // namespace
std::span<const CoveredEntry> covered_registry() { return kEntries; }
}  // namespace fastsplat::testbench
]=])
target_sources(fastsplat_covered_rtl PRIVATE ${registry})
