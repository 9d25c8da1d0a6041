# The example bench of capi/example under Verilator, with the faults of testbench/faults to choose from: tiny alone, as
# another simulator's user would build it.
set(folder ${PROJECT_BINARY_DIR}/verilated/capi_bench)
set(FASTSPLAT_CAPI_BENCH ${folder}/obj/Vfastsplat_bench)
file(GLOB rtl CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/rtl/*.sv ${PROJECT_SOURCE_DIR}/rtl/*.svh)
set(modules ${rtl})
list(FILTER modules INCLUDE REGEX "\\.sv$")
set(package ${folder}/fastsplat_pkg.sv)
set(faults ${PROJECT_BINARY_DIR}/generated/mustfail/fastsplat_fault_pkg.sv)
set(bench ${PROJECT_SOURCE_DIR}/capi/sv/fastsplat_dpi_pkg.sv ${PROJECT_SOURCE_DIR}/capi/sv/fastsplat_monitor.sv ${PROJECT_SOURCE_DIR}/capi/example/fastsplat_bench.sv)
file(MAKE_DIRECTORY ${folder}/obj)
add_custom_command(
  OUTPUT ${package}
  COMMAND fastsplat_emit_package tiny > ${package}.new
  COMMAND ${CMAKE_COMMAND} -E copy_if_different ${package}.new ${package}
  DEPENDS fastsplat_emit_package
  COMMENT "Package of the example bench")
add_custom_command(
  OUTPUT ${FASTSPLAT_CAPI_BENCH}
  COMMAND ${PROJECT_SOURCE_DIR}/cmake/verilate.sh ${folder}/verilator.log ${CMAKE_COMMAND} -E env OBJCACHE=${FASTSPLAT_CCACHE} ${VERILATOR} --binary --timing --assert -j 1 --quiet-exit
          --top-module fastsplat_bench --Mdir ${folder}/obj -DFASTSPLAT_FAULT_SELECT=fastsplat_fault_pkg::selected -I${PROJECT_SOURCE_DIR}/rtl
          -MAKEFLAGS OPT_FAST=-O1 -MAKEFLAGS OPT_SLOW=-O0 -MAKEFLAGS OPT_GLOBAL=-O0
          -LDFLAGS "-L$<TARGET_FILE_DIR:fastsplat_capi> -Wl,-rpath,$<TARGET_FILE_DIR:fastsplat_capi> -lfastsplat"
          ${package} ${faults} ${modules} ${bench}
  DEPENDS ${package} ${faults} ${rtl} ${bench} fastsplat_capi
  VERBATIM
  COMMENT "Verilating the example bench")
add_custom_target(capi_bench DEPENDS ${FASTSPLAT_CAPI_BENCH})
