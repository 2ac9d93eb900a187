#!/bin/sh
# Refreshes the bundles beside this file (make page-vendor): what the page uses of three.js, uPlot,
# and two writers of films, in the versions package.json names. Needs node and npm; the page neither.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cp "$here/package.json" "$here/three.entry.js" "$here/films.entry.js" "$work"
cd "$work"
npm install --ignore-scripts --no-audit --no-fund --no-package-lock --loglevel=error
bundle() {
  npx esbuild "$1" --bundle --minify --format=esm --target=es2022 --legal-comments=inline \
    --outfile="$here/$2" --log-level=warning
}
bundle three.entry.js three.js
bundle films.entry.js films.js
bundle node_modules/uplot/dist/uPlot.esm.js uplot.js
cp node_modules/uplot/dist/uPlot.min.css "$here/uplot.css"
cp node_modules/three/LICENSE "$here/LICENSE-three.txt"
cp node_modules/uplot/LICENSE "$here/LICENSE-uplot.txt"
cp node_modules/webm-muxer/LICENSE "$here/LICENSE-webm-muxer.txt"
cp node_modules/gifenc/LICENSE.md "$here/LICENSE-gifenc.txt"
ls -l "$here"
