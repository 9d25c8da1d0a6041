# The example bench of testbench/capi/example under Verilator, with selectable faults of testbench/faults. Built as a
# user of another simulator would: for tiny, and for a device that culls.
file(GLOB rtl CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/rtl/*.sv ${PROJECT_SOURCE_DIR}/rtl/*/*.sv ${PROJECT_SOURCE_DIR}/rtl/*.svh)
set(modules ${rtl})
list(FILTER modules INCLUDE REGEX "\\.sv$")
set(faults ${PROJECT_BINARY_DIR}/share/fastsplat/fastsplat_fault_pkg.sv)
set(bench ${PROJECT_SOURCE_DIR}/testbench/capi/sv/fastsplat_dpi_pkg.sv ${PROJECT_SOURCE_DIR}/testbench/capi/sv/fastsplat_monitor.sv ${PROJECT_SOURCE_DIR}/testbench/capi/example/fastsplat_bench.sv)

# example_bench(OUT FOLDER CONFIG [FLAG...]): the program, and the commands that build it.
function(example_bench out name config)
  set(folder ${PROJECT_BINARY_DIR}/verilated/${name})
  set(package ${folder}/fastsplat_pkg.sv)
  set(program ${folder}/obj/Vfastsplat_bench)
  file(MAKE_DIRECTORY ${folder}/obj)
  add_custom_command(
    OUTPUT ${package}
    COMMAND fastsplat_emit_package ${config} > ${package}.new
    COMMAND ${CMAKE_COMMAND} -E copy_if_different ${package}.new ${package}
    DEPENDS fastsplat_emit_package
    COMMENT "Package of the example bench")
  add_custom_command(
    OUTPUT ${program}
    COMMAND ${CMAKE_COMMAND} -E rm -f ${program}  # Verilator's makefile does not see that the library changed
    COMMAND ${PROJECT_SOURCE_DIR}/tools/cmake/verilate.sh ${folder}/verilator.log ${CMAKE_COMMAND} -E env OBJCACHE=${FASTSPLAT_CCACHE} ${VERILATOR} --binary --timing ${ARGN} -j 1 --quiet-exit
            --top-module fastsplat_bench --Mdir ${folder}/obj -DFASTSPLAT_FAULT_SELECT=fastsplat_fault_pkg::selected -I${PROJECT_SOURCE_DIR}/rtl
            -MAKEFLAGS OPT_FAST=-O1 -MAKEFLAGS OPT_SLOW=-O0 -MAKEFLAGS OPT_GLOBAL=-O0
            -LDFLAGS "-L$<TARGET_FILE_DIR:fastsplat_capi> -Wl,-rpath,$<TARGET_FILE_DIR:fastsplat_capi> -lfastsplat"
            ${package} ${faults} ${modules} ${bench}
    DEPENDS ${package} ${faults} ${rtl} ${bench} fastsplat_capi
    VERBATIM
    COMMENT "Verilating the example bench of ${config}")
  set(${out} ${program} PARENT_SCOPE)
endfunction()
example_bench(FASTSPLAT_CAPI_BENCH capi_bench tiny --assert)
# Without the device's assertions, which would fire before the checker reports.
example_bench(FASTSPLAT_CAPI_BENCH_CULL capi_bench_cull ${PROJECT_SOURCE_DIR}/configs/faults/cull.toml)
add_custom_target(capi_bench DEPENDS ${FASTSPLAT_CAPI_BENCH} ${FASTSPLAT_CAPI_BENCH_CULL})
