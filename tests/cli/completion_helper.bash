# SPDX-License-Identifier: Apache-2.0
# Stands in for the TAB key: fastsplat.bash LINE... -> for each line what a bash offers at its end, one reply a line, behind
# "> LINE". Breaks the line into words as bash does, at COMP_WORDBREAKS.
source "$1" || exit 1
shift
compopt() { :; }  # only means something while bash itself completes
COMP_WORDBREAKS=$' \t\n"\'><=;|&(:'
for line; do
  COMP_LINE=$line COMP_POINT=${#line} COMP_WORDS=() COMP_CWORD=0 COMPREPLY=()
  printf '> %s\n' "$line"
  _fastsplat
  (( ${#COMPREPLY[@]} )) && printf '%s\n' "${COMPREPLY[@]}"
done
exit 0
