# fastsplat_fault_package(<list> <package>): generates <package> at configure time: the number of each FAULT(NAME, ...) line of
# <list>, their count, and the selected one (rtl/fault.svh).
function(fastsplat_fault_package list package)
  file(STRINGS ${list} lines REGEX "^FAULT\\(")
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${list})
  set(numbers "")
  set(number 0)
  foreach(line ${lines})
    string(REGEX MATCH "^FAULT\\(([A-Z0-9_]+)," unused "${line}")
    math(EXPR number "${number} + 1")
    string(APPEND numbers "  localparam int ${CMAKE_MATCH_1} = ${number};\n")
  endforeach()
  file(RELATIVE_PATH source ${PROJECT_SOURCE_DIR} ${list})
  file(CONFIGURE OUTPUT ${package} @ONLY CONTENT [=[
// Generated from @source@; do not edit.
package fastsplat_fault_pkg;
@numbers@  // verilator lint_off UNUSEDPARAM
  localparam int FAULTS = @number@;
  // verilator lint_on UNUSEDPARAM
`ifdef VERILATOR
  int selected  /* verilator public_flat_rw */;
`endif
endpackage
]=])
endfunction()
