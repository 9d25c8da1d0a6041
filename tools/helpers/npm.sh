# SPDX-License-Identifier: Apache-2.0
# For scripts that need packages of npm or a browser; source it. They end with exit code 77, and the reason, where node or the registry is
# not to be had.

skip() {
  printf '%s\n' "skipped: $1"
  exit 77
}

# need_node: node 18 or newer
need_node() {
  command -v node >/dev/null || skip "no node (Debian: nodejs)"
  node -e 'process.exit(Number(process.versions.node.split(".")[0]) >= 18 ? 0 : 1)' || skip "node $(node --version) is older than 18"
}

# npm_into FOLDER LISTS [NAME...]: installs packages of LISTS/package-lock.json in FOLDER, unless they are there
npm_into() {
  local folder=$1 lists=$2
  shift 2
  cp -- "$lists/package.json" "$folder"
  node "$(dirname -- "${BASH_SOURCE[0]}")/npm_files.mjs" "$lists/package-lock.json" "$folder" "$@" || exit
}

# need_chromium: sets CHROMIUM to a browser's path
need_chromium() {
  local name
  for name in chromium chromium-headless-shell google-chrome; do
    CHROMIUM=$(command -v "$name") && return
  done
  skip "no chromium (Debian: chromium)"
}
