#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# build.sh SHARE PACKAGE MODULE [wave] [faults]: builds the simulator of one configuration as a shared library.
# SHARE holds rtl/ and testbench/module/; PACKAGE is the configuration's fastsplat_pkg.sv; MODULE the file to write, last
# and atomically. `wave`: it can write waveforms. `faults`: it holds every fault of SHARE/fastsplat_fault_pkg.sv, one of
# them selected at run time. Prints "files N", then a line for each of the N files as it is compiled. CXX is the
# compiler, JOBS the number of parallel jobs.
set -eu
share=$1 package=$2 module=$3
shift 3
work=$module.building
trap 'rm -rf "$work"' EXIT
trap 'exit 130' INT TERM HUP
rm -rf "$work"
mkdir -p "$work"

source=$share/testbench/module
flags="-std=c++20 -fPIC -fvisibility=hidden -I$share -include $source/simulator_output.hpp -DVL_PRINTF=fastsplat::testbench::simulator_print"
# Assertions are compiled in and switched at run time. Unset bits are drawn when a device is made (x-assign, x-initial).
set -- "$@" --
for ability; do
  shift
  case $ability in
    wave) set -- "$@" --trace-fst ;;
    faults)
      flags="$flags -DFASTSPLAT_FAULTS"
      set -- "$@" -DFASTSPLAT_FAULT_SELECT=fastsplat_fault_pkg::selected "$share/fastsplat_fault_pkg.sv" ;;
  esac
done
# A simulator that writes waveforms keeps every signal and runs briefly: compile time counts more than its speed.
speed=-O2
case " $* " in *" --trace-fst "*) speed=-O0 ;; esac

verilator --cc --exe --quiet-exit -Wno-fatal -Wno-lint -O3 --assert --x-assign unique --x-initial unique \
  --prefix Vfs --top-module fastsplat_dut --Mdir "$work" "-I$share/rtl" \
  -CFLAGS "$flags" -LDFLAGS "-shared" -o module.so \
  "$@" "$package" "$share"/rtl/*.sv "$share"/rtl/*/*.sv "$source"/*.sv "$source/module.cpp" "$source/simulator_output.cpp"
# The many files of a large device all read the same long headers: some are compiled as one.
# together VARIABLE COUNT: the files that VARIABLE of Vfs_classes.mk lists, in COUNT files that include them.
together() {
  names=$(sed -n "/^$1 +=/,/^\$/s/^[[:space:]]\([A-Za-z0-9_]*\) .*/\1/p" "$work/Vfs_classes.mk")
  number=0 parts=
  for name in $names; do
    part=$1_$((number % $2))
    [ "$number" -ge "$2" ] || parts="$parts $part"
    echo "#include \"$name.cpp\"" >>"$work/$part.cpp"
    number=$((number + 1))
  done
  sed -i "/^$1 +=/,/^\$/c $1 =$parts" "$work/Vfs_classes.mk"
}
if grep -q '^VM_PARALLEL_BUILDS = 1' "$work/Vfs_classes.mk"; then
  together VM_CLASSES_FAST 4
  together VM_CLASSES_SLOW 2
fi
echo "files $(make -n -C "$work" -f Vfs.mk | grep -c -e ' -c -o ')"
# VK_PCH_I_...: Verilator 5.032 would include a precompiled header whose rule the groups do not have.
make -C "$work" -f Vfs.mk -j "${JOBS:-1}" OPT_FAST="$speed" OPT_SLOW=-O0 OPT_GLOBAL="$speed" VK_PCH_I_FAST= VK_PCH_I_SLOW= ${CXX:+CXX="$CXX" LINK="$CXX"}
mv "$work/module.so" "$module"
