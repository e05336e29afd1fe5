#!/bin/sh
# install.sh SOURCE FOLDER: copies the tests into the build folder and installs there what package-lock.json names, once for each lock file.
set -e
mkdir -p "$2"
rm -f "$2"/*.mjs
cp "$1"/*.mjs "$1"/package.json "$2"
cmp -s "$1/package-lock.json" "$2/package-lock.json" && [ -d "$2/node_modules/playwright-core" ] && exit 0
cp "$1/package-lock.json" "$2"
cd "$2"
npm ci --ignore-scripts --no-audit --no-fund
