# Verilates rtl/ into a program, for tests and tools that simulate other RTL than a configuration's module (testbench/device/rtl_module.hpp).
# Verilator runs at build time, after the configuration's package is generated.
find_program(VERILATOR verilator REQUIRED)
execute_process(COMMAND ${VERILATOR} --getenv VERILATOR_ROOT OUTPUT_VARIABLE VERILATOR_ROOT OUTPUT_STRIP_TRAILING_WHITESPACE)
if(NOT EXISTS ${VERILATOR_ROOT}/include/verilated.cpp)
  set(VERILATOR_ROOT /usr/share/verilator)
endif()

# The simulator's runtime, shared by all configurations.
find_package(Threads REQUIRED)
add_library(verilated_runtime STATIC ${VERILATOR_ROOT}/include/verilated.cpp ${VERILATOR_ROOT}/include/verilated_threads.cpp
                                      ${VERILATOR_ROOT}/include/verilated_cov.cpp
                                     ${PROJECT_SOURCE_DIR}/testbench/module/simulator_output.cpp)
target_include_directories(verilated_runtime SYSTEM PUBLIC ${VERILATOR_ROOT}/include ${VERILATOR_ROOT}/include/vltstd)
target_include_directories(verilated_runtime PRIVATE ${PROJECT_SOURCE_DIR})
target_compile_features(verilated_runtime PRIVATE cxx_std_20)
target_compile_definitions(verilated_runtime PRIVATE VL_PRINTF=fastsplat::testbench::simulator_print)
target_compile_options(verilated_runtime PRIVATE -w -include ${PROJECT_SOURCE_DIR}/testbench/module/simulator_output.hpp)
target_link_libraries(verilated_runtime PUBLIC Threads::Threads)

# fastsplat_verilate(<target> <config> [ASSERT] [DEFINES ...] [SOURCES ...] [ARGS ...]): library <target> with class Vfs_<target>
# and its headers. <config> is a name in configs/ or a path. DEFINES and SOURCES are for the must-fail build (rtl/fault.svh); release builds have none.
# ASSERT: checks the assertions of rtl/.
# RTL <folder>: uses the source generated from rtl/ there (tests/mutants). QUICK: favours compile time over simulation speed.
# TOP <module>: another top module than the testbench's wrapper fastsplat_dut. NETLIST <kind>: simulates Yosys' netlist (tools/cmake/netlist.sh); CUT <net>: ties that net to 0.
function(fastsplat_verilate target config)
  cmake_parse_arguments(arg "ASSERT;QUICK" "NETLIST;CUT;RTL;TOP" "DEFINES;SOURCES;ARGS" ${ARGN})
  set(abilities "")
  set(optimise -O2)
  set(optimise_runtime -O2)
  if(arg_ASSERT)
    list(APPEND abilities --assert)
  endif()
  file(GLOB RTL_SOURCES CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/rtl/*.sv ${PROJECT_SOURCE_DIR}/rtl/*/*.sv)
  file(GLOB RTL_INCLUDES CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/rtl/*.svh)
  set(rtl_folder ${PROJECT_SOURCE_DIR}/rtl)
  set(warnings -Wall)
  set(top fastsplat_dut)
  file(GLOB bench CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/testbench/module/*.sv)
  if(arg_TOP)
    set(top ${arg_TOP})
    set(bench "")
    list(APPEND warnings -Wno-UNUSEDPARAM)  # a unit uses only parts of the package
  endif()
  if(arg_RTL)
    list(TRANSFORM RTL_SOURCES REPLACE "^.*/" "${arg_RTL}/")
    set(RTL_INCLUDES ${arg_RTL}/mutants.json)
    set(rtl_folder ${arg_RTL})
    # Mutants are wrong on purpose; warnings are useless.
    set(warnings -Wno-lint -Wno-fatal)
  endif()
  if(arg_QUICK)
    set(optimise -O1)
    set(optimise_runtime -O1)
  endif()
  set(folder ${PROJECT_BINARY_DIR}/verilated/${target})
  set(file ${config})
  if(NOT file MATCHES "\\.toml$")
    set(file ${PROJECT_SOURCE_DIR}/configs/${config}.toml)
  endif()
  set(package ${folder}/fastsplat_pkg.sv)
  file(MAKE_DIRECTORY ${folder}/obj)
  add_custom_command(
    OUTPUT ${package}
    COMMAND fastsplat_emit_package ${file} > ${package}.new
    COMMAND ${CMAKE_COMMAND} -E copy_if_different ${package}.new ${package}  # unchanged: nothing to verilate again
    DEPENDS fastsplat_emit_package ${file}
    COMMENT "Package of configuration ${config}")
  set(defines "")
  foreach(define ${arg_DEFINES})
    list(APPEND defines -D${define})
  endforeach()
  set(sources ${package} ${arg_SOURCES} ${RTL_SOURCES} ${bench})
  if(arg_NETLIST)
    set(netlist ${folder}/netlist.v)
    list(FILTER bench EXCLUDE REGEX "/fastsplat_dut.sv$")  # it is in the netlist's file
    set(sources ${package} ${netlist} ${bench})
    # Yosys' Verilog mixes widths wherever the language allows it.
    set(warnings -Wno-lint -Wno-fatal)
    # The cells are half a million lines of C++, simulated for seconds only.
    if(arg_NETLIST STREQUAL "ice40")
      set(optimise -O0)
    endif()
    set(dut ${PROJECT_SOURCE_DIR}/testbench/module/fastsplat_dut.sv)
    set(netlist_script ${PROJECT_SOURCE_DIR}/tools/cmake/netlist.sh)
    add_custom_command(
      OUTPUT ${netlist}
      COMMAND ${netlist_script} ${arg_NETLIST} ${PROJECT_SOURCE_DIR}/rtl ${dut} ${package} ${netlist} ${arg_CUT}
      DEPENDS ${netlist_script} ${dut} ${package} ${RTL_SOURCES} ${RTL_INCLUDES}
      VERBATIM
      COMMENT "Netlist ${target}")
  endif()
  set(archive ${folder}/obj/Vfs_${target}__ALL.a)
  add_custom_command(
    OUTPUT ${archive} ${folder}/obj/Vfs_${target}.h
    COMMAND ${PROJECT_SOURCE_DIR}/tools/cmake/verilate.sh ${folder}/verilator.log ${CMAKE_COMMAND} -E env OBJCACHE=${FASTSPLAT_CCACHE} ${VERILATOR} --cc --build -j 1 --quiet-exit ${warnings} -O3 --x-assign unique --x-initial unique ${abilities}
            --prefix Vfs_${target} --top-module ${top} --Mdir ${folder}/obj ${defines} ${arg_ARGS} -I${rtl_folder}
            -CFLAGS -std=c++20 -MAKEFLAGS OPT_FAST=${optimise} -MAKEFLAGS OPT_SLOW=-O0 -MAKEFLAGS OPT_GLOBAL=${optimise_runtime} ${sources}
    DEPENDS ${sources} ${RTL_INCLUDES}
    VERBATIM
    COMMENT "Verilating ${target}")
  add_custom_target(verilate_${target} DEPENDS ${archive})
  add_library(${target} INTERFACE)
  add_dependencies(${target} verilate_${target})
  target_include_directories(${target} SYSTEM INTERFACE ${folder}/obj)
  target_link_libraries(${target} INTERFACE ${archive} verilated_runtime)
endfunction()
