"""Every kind of cmd/input/kinds/kinds.json, and every place that its row names, stands in a file with judged pixels.
   python3 kinds_fields.py cmd/input/kinds/kinds.json tests/importers/fixtures"""
import json
import sys
from pathlib import Path

# What a file may have and is refused for, or what is no camera's: golden cases have these.
OTHERS = {"roi", "x_offset", "y_offset", "binning_x", "binning_y", "T_cam_imu", "applied_transform", "applied_scale",
          "from_mitsuba", "transform_matrix_start", "rolling_shutter", "Tr_velo_to_cam", "R0_rect"} | {
    f"{name}{which}" for name in ("dist_coeffs", "dist", "distortion") for which in "12"}
NO_PLACES = {"kind", "form", "source", "lengths", "like", "convention", "axes", "order", "pose", "focalIn", "centerIn", "angles",
             "quaternionOrder", "pixelCenter", "scale"}
# The document's own names for what COLMAP's lines have in order.
LINES = {"colmap", "colmap-cameras"}


def places(row):
    for word, value in row.items():
        if word in NO_PLACES or value is None:
            continue
        if word == "views":
            for view in value.values():
                yield from places(view)
        elif word == "only":
            yield from value
        elif word == "notes":
            for about in value.values():
                yield from about
        else:
            stack = [value]
            while stack:
                each = stack.pop()
                if isinstance(each, str):
                    yield each
                elif isinstance(each, list):
                    stack += each


rows = json.loads(Path(sys.argv[1]).read_text())
fixtures = [Path(sys.argv[2], name).read_text() for name in ("kinds.jsonl", "opencv.jsonl")]
judged = {json.loads(line)["kind"] for line in fixtures[0].splitlines()}
text = "".join(fixtures).replace('\\"', '"')
missing = [f"kind {row['kind']}" for row in rows if row["kind"] not in judged]
count = 0
for row in rows:
    for place in () if row["kind"] in LINES else places(row):
        for step in place.split("[")[0].split("."):
            name = step.strip("/{}*")
            count += 1
            if name and not name.isdigit() and name not in OTHERS and f'"{name}"' not in text and f"{name}:" not in text:
                missing.append(f"{row['kind']}: {name}")
# And the page tells what its pixels were compared with.
page = (Path(__file__).resolve().parents[2] / "cmd" / "README.md").read_text()
missing += [f"cmd/README.md: {row['kind']}" for row in rows if f"| `{row['kind']}` |" not in page]
if missing:
    sys.exit("in no fixture or page: " + ", ".join(sorted(set(missing))))
print(f"{count} names of {len(rows)} kinds judged")
