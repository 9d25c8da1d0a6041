// SPDX-License-Identifier: Apache-2.0
// Places where the must-fail suite breaks the device (testbench/faults/faults.def). In all other builds the macro is
// the constant 0 and leaves nothing behind: only a build that defines FASTSPLAT_FAULT_SELECT can set a fault. It also
// needs fastsplat_fault_pkg.sv (testbench/faults), which is not part of the device.
//   FASTSPLAT_FAULT_SELECT=fastsplat_fault_pkg::selected      one simulation, fault chosen at run time
//   FASTSPLAT_FAULT_SELECT=fastsplat_fault_pkg::FORWARD_2     that fault always
`ifndef FASTSPLAT_FAULT_SVH
`define FASTSPLAT_FAULT_SVH
`ifdef FASTSPLAT_FAULT_SELECT
`define FASTSPLAT_FAULT(NAME) (`FASTSPLAT_FAULT_SELECT == fastsplat_fault_pkg::NAME)
`else
`define FASTSPLAT_FAULT(NAME) 1'b0
`endif
`endif
