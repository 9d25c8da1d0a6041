# SPDX-License-Identifier: Apache-2.0
# For tests in bash that need packages of npm; source it. They are skipped (exit code 77, with the reason) where node, npm or
# the registry is not to be had.

skip() {
  printf '%s\n' "skipped: $1"
  exit 77
}

# need_node: skips without node 18 and npm
need_node() {
  command -v node >/dev/null || skip "no node (Debian: nodejs)"
  command -v npm >/dev/null || skip "no npm (Debian: npm)"
  node -e 'process.exit(Number(process.versions.node.split(".")[0]) >= 18 ? 0 : 1)' || skip "node $(node --version) is older than 18"
}

# npm_into FOLDER LISTS: installs the packages of LISTS/package-lock.json in FOLDER, unless they are there
npm_into() {
  local folder=$1 lists=$2 stamp
  stamp=$(cksum <"$lists/package-lock.json")
  [[ -f $folder/.installed && $(<"$folder/.installed") == "$stamp" ]] && return
  cp -- "$lists/package.json" "$lists/package-lock.json" "$folder"
  if ! (cd -- "$folder" && npm ci --no-update-notifier --no-fund --no-audit >npm.log 2>&1); then
    grep -qE 'ENOTFOUND|CERT_|_CERT|ECONNREFUSED|ECONNRESET|ETIMEDOUT|EAI_AGAIN|ENETUNREACH|ENOTCACHED' "$folder/npm.log" &&
      skip "npm cannot reach its registry: see $folder/npm.log"
    cat -- "$folder/npm.log" >&2
    exit 1
  fi
  printf '%s' "$stamp" >"$folder/.installed"
}
