#!/usr/bin/env bash
# chromium.sh MENISCAL SCENES: opens a page of `meniscal tradeoff` from disk in headless Chromium, without a network, and asks there whether
# all of it is shown. CHROMIUM: the browser's program. Exit code 77: there is none.
set -euo pipefail

browser=${CHROMIUM:-$(command -v chromium || command -v chromium-browser || true)}
if [[ -z $browser ]]; then
  echo "skipped: Chromium is missing; install the package chromium, or set CHROMIUM" >&2
  exit 77
fi
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$1" tradeoff "$2/post.gltf" --quick --quiet -o "$folder/post.html"

# The page with a question at its end, whose answer becomes part of it.
cat "$folder/post.html" - > "$folder/asked.html" <<'END'
<script>
window.onload = () => {
  const wrong = [];
  const images = [...document.images], charts = [...document.querySelectorAll("svg")];
  const expect = (holds, what) => { if (!holds) wrong.push(what); };
  expect(images.length == 12, "12 pictures, not " + images.length);
  for (const i of images) expect(i.complete && i.naturalWidth > 0 && i.getBoundingClientRect().width > 100, "picture " + i.alt);
  expect(charts.length >= 6, "6 charts, not " + charts.length);
  for (const chart of charts) {
    const frame = chart.getBoundingClientRect();
    const marks = chart.querySelectorAll("text, circle, polyline, line");
    expect(chart.querySelectorAll("circle").length >= 7, "seven points");
    for (const mark of marks) {
      const box = mark.getBoundingClientRect();
      expect(box.left >= frame.left - 1 && box.right <= frame.right + 1 && box.top >= frame.top - 1 && box.bottom <= frame.bottom + 1,
             "in its chart: " + mark.outerHTML);
    }
  }
  expect(document.documentElement.scrollWidth <= window.innerWidth, "no wider than the window");
  const loaded = performance.getEntriesByType("resource").map(r => r.name).filter(name => !name.startsWith("data:"));
  expect(loaded.length == 0, "nothing from elsewhere: " + loaded);
  const answer = document.createElement("pre");
  answer.id = wrong.length == 0 ? "page-is-whole" : "page-is-wrong";
  answer.textContent = wrong.join("\n");
  document.body.append(answer);
};
</script>
END
"$browser" --headless --no-sandbox --disable-gpu --user-data-dir="$folder/profile" --host-resolver-rules="MAP * ~NOTFOUND" \
  --window-size=1400,1000 --virtual-time-budget=10000 --dump-dom "file://$folder/asked.html" > "$folder/answer.html" 2> "$folder/log"
if ! grep -q '<pre id="page-is-whole">' "$folder/answer.html"; then
  sed -n '/<pre id="page-is-wrong">/,/<\/pre>/p' "$folder/answer.html" >&2
  tail -n 5 "$folder/log" >&2
  echo "chromium.sh: the page is not shown as it should be" >&2
  exit 1
fi
