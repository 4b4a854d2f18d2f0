"""Many cameras at once give what each gives alone.

  python3 -B sets.py VIEWPROJ

Random cameras and records. Through --camera-by, --each-camera and --camera-in-record each result is compared, byte for
byte, with that of a run with this camera alone; and one job's bytes with two jobs'.
"""
import json
import random
import subprocess
import sys

TOOL = sys.argv[1]
RECORDS = 900  # several blocks' worth of batches


def run(command, given, *options):
    done = subprocess.run([TOOL, command, *options], input=given.encode(), capture_output=True, check=False)
    if done.returncode != 0:
        sys.exit(f"viewproj {command} {' '.join(options)}: {done.stderr.decode()}")
    return done.stdout.decode().splitlines()


def some_cameras(r):
    def camera(i):
        lens = r.choice([{"type": "perspective", "fovY": r.uniform(20, 90), "near": 0.1},
                         {"type": "perspective", "fovX": r.uniform(20, 90)},
                         {"type": "orthographic", "height": r.uniform(5, 30), "near": 0.1, "far": 50},
                         {"type": "intrinsics", "fx": r.uniform(50, 200), "fy": r.uniform(50, 200), "cx": 60, "cy": 40}])
        own = {"name": f"cam {i}", "position": [r.uniform(-9, 9), r.uniform(-9, 9), r.uniform(5, 20)],
               "target": [0, 0, 0], "projection": lens}
        if lens["type"] == "intrinsics":
            own["distortion"] = {"model": "brown", "k": [r.uniform(-0.1, 0.1), 0], "p": [0.001, 0]}
        return own
    return [camera(i) for i in range(7)]


def same(what, expected, got):
    if expected != got:
        at = next((i for i, (a, b) in enumerate(zip(expected, got)) if a != b), min(len(expected), len(got)))
        sys.exit(f"{what}: line {at + 1} differs\n  alone {expected[at:at + 1]}\n  set   {got[at:at + 1]}")


def jobs_agree(command, given, *options):
    one = run(command, given, *options, "--jobs", "1")
    same(f"{command} --jobs 2", one, run(command, given, *options, "--jobs", "2"))
    return one


def check(r, command, record, extra, shared, cameras):
    document = json.dumps({**shared, "cameras": cameras})
    names = [r.choice(cameras)["name"] for _ in range(RECORDS)]
    records = [record(r) for _ in range(RECORDS)]
    alone = {camera["name"]: run(command, "".join(json.dumps(one) + "\n" for one in records), "-c",
                                 document + "#" + camera["name"], *extra) for camera in cameras}

    # JSON, CSV and lines of numbers that name their cameras: by name, and by number.
    given = "".join(json.dumps({**one, "of": name}) + "\n" for one, name in zip(records, names))
    expected = [json.dumps({**one, "of": name})[:-1] + alone[name][i][len(json.dumps(one)) - 1:]
                for i, (one, name) in enumerate(zip(records, names))]
    same(f"{command} --camera-by", expected, jobs_agree(command, given, "-c", document, "--camera-by", "of", *extra))

    # Every record through every camera.
    given = "".join(json.dumps(one) + "\n" for one in records[:60])
    expected = [json.dumps(one)[:-1] + f',"camera":"{camera["name"]}"' + alone[camera["name"]][i][len(json.dumps(one)) - 1:]
                for i, one in enumerate(records[:60]) for camera in cameras]
    got = jobs_agree(command, given, "-c", document, "--each-camera", *extra)
    same(f"{command} --each-camera", expected, got)
    if command != "ray":
        seen = [line for line in expected if '"visible":true' in line or '"cull":"i' in line]
        assert 0 < len(seen) < len(expected)
        same(f"{command} --visible", seen,
             jobs_agree(command, given, "-c", document, "--each-camera", "--visible", *extra))

    # The cameras in the records themselves. The point's own fields stay the point's.
    of = {camera["name"]: camera for camera in cameras}
    place = (lambda camera: {f"position.{a}": v for a, v in zip("xyz", camera["position"])})
    own = [{**one, **place(of[name]), **{k: v for k, v in of[name].items() if k not in ("name", "position")}}
           for one, name in zip(records, names)]
    given = "".join(json.dumps(one) + "\n" for one in own)
    expected = [json.dumps(one)[:-1] + alone[name][i][len(json.dumps(records[i])) - 1:]
                for i, (one, name) in enumerate(zip(own, names))]
    same(f"{command} --camera-in-record", expected,
         jobs_agree(command, given, "-c", json.dumps(shared), "--camera-in-record", *extra))


def check_numbers(r, shared, cameras):
    """The same in CSV and in lines of numbers, by the cameras' numbers."""
    document = json.dumps({**shared, "cameras": cameras})
    points = [[round(r.uniform(-6, 6), 3) for _ in range(3)] for _ in range(RECORDS)]
    numbers = [r.randrange(len(cameras)) for _ in points]
    lines = "".join("{} {} {}\n".format(*p) for p in points)
    alone = [run("project", lines, "-c", f"{document}#{i}", "--from", "text") for i in range(len(cameras))]
    expected = [alone[n][i] for i, n in enumerate(numbers)]
    given = "".join("{} {} {} {}\n".format(*p, n) for p, n in zip(points, numbers))
    same("text", expected, jobs_agree("project", given, "-c", document, "--camera-by", "4", "--columns", "1,2,3"))
    given = "x,y,z,of\n" + "".join("{},{},{},{}\n".format(*p, n) for p, n in zip(points, numbers))
    got = jobs_agree("project", given, "-c", document, "--camera-by", "of")
    same("CSV", [one.replace(" ", ",").replace("NaN", "") for one in expected],
         [",".join(one.split(",")[4:7]) for one in got[1:]])


def point(r):
    return {"id": r.randrange(99), "x": r.uniform(-6, 6), "y": r.uniform(-6, 6), "z": r.uniform(-30, 20)}


def pixel(r):
    return {"pixel": [r.uniform(0, 120), r.uniform(0, 80)]}


def main():
    shared = {"up": [0, 1, 0], "viewport": {"width": 120, "height": 80}}
    for seed in range(3):
        r = random.Random(seed)
        cameras = some_cameras(r)
        check(r, "project", point, [], shared, cameras)
        check(r, "ray", pixel, ["--plane", "z=-40"], shared, cameras)
        check(r, "cull", lambda r: {**point(r), "radius": r.uniform(0, 1)}, ["--ignore-distortion", "--quiet"], shared,
              cameras)
        check_numbers(r, shared, cameras)
    print("sets agree with each camera alone")


main()
