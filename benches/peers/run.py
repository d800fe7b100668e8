#!/usr/bin/env python3
"""How much longer a dense program takes than Tautline, for the same critical speeds: a markdown table.

    python3 benches/peers/run.py [--tautline PATH] [--rounds N] [--json FILE]

The dense program is tests/reference/oracle.py with numpy and scipy, on one thread, timed inside its process without the
start of the interpreter.  Tautline is `tautline analyze FILE --json`, timed from outside: start, reading, writing and
exit are on its account.  Both compute statics, length rates, the spectrum and the critical speed up to 40 m/s of the
same files, in turn; medians are compared, and the critical speeds have to agree.
"""

import argparse
import importlib.util
import json
import math
import os
import platform
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

# The oracle leaves nothing beside its source.
sys.dont_write_bytecode = True
# Read when numpy is loaded: one thread, as Tautline has.
for name in ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "BLIS_NUM_THREADS", "OMP_NUM_THREADS"):
    os.environ[name] = "1"

try:
    import numpy
    import scipy
except ImportError as missing:
    sys.exit(f"{missing}: this needs python3 with numpy and scipy (benches/peers/README.md)")

ROOT = Path(__file__).resolve().parents[2]
REFERENCE = ROOT / "tests" / "reference"
MAX_SPEED = 40.0
# Critical speeds agree to this, in m/s: the oracle refines to 1e-9.
AGREEMENT = 1e-6
# Where one round of the oracle takes longer than this, in s, fewer rounds will do.
LONG, LONG_ROUNDS = 10.0, 3
# Runs of Tautline per round of the oracle.
RUNS = 7


def build():
    """Builds the command line alone, and gives its path."""
    command = ["cargo", "build", "--release", "--no-default-features", "--features", "cli", "--message-format=json"]
    done = subprocess.run(command, cwd=ROOT, stdout=subprocess.PIPE, text=True, check=False)
    if done.returncode != 0:
        sys.exit("the program could not be built")
    messages = map(json.loads, done.stdout.splitlines())
    programs = [message["executable"] for message in messages if message.get("executable")]
    return Path(next(program for program in programs if Path(program).stem == "tautline"))


def load_oracle():
    """The oracle as a module that keeps in `scan` how long its last scan took, and of which size."""
    spec = importlib.util.spec_from_file_location("oracle", REFERENCE / "oracle.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    search = module.critical_speed

    def timed(dynamics, *rest):
        took, result = seconds(lambda: search(dynamics, *rest))
        module.scan = {"time": took, "size": 2 * dynamics.size}
        return result

    module.critical_speed = timed
    return module


def output_of(command):
    """What a program prints; its message where it fails."""
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}: {done.stderr.strip()}")
    return done.stdout


def scenarios(tautline, oracle):
    """Names with their scenarios: the built-in ones, the finer mesh of one, and two files of the reference."""
    paper = json.loads(output_of([tautline, "example", "paper"]))
    tangent = {**paper, "linearisation": "tangent"}
    fine = {**tangent, "elements_per_cable": 40}
    named = [("paper's robot, secant", paper), ("paper's robot, tangent", tangent), ("the same, finer mesh", fine)]
    for title, file in (("eight cables", "extra_03_eight_cables"), ("finest reference mesh", "extra_08_twenty_four_elements")):
        named.append((title, oracle.load_scenario(REFERENCE / f"{file}.json")))
    return named


def seconds(task):
    """The time of one call, and what it gives."""
    begun = time.perf_counter()
    result = task()
    return time.perf_counter() - begun, result


def compare(oracle, tautline, scenario, file, rounds):
    """Times in s: the oracle's whole analysis and its scan alone, Tautline's whole process; with the critical speeds."""
    file.write_text(json.dumps(scenario))
    command = [str(tautline), "analyze", str(file), "--json", "--max-speed", str(MAX_SPEED)]
    whole, scan, own = [], [], []
    done = 0
    while done < rounds:
        for _ in range(RUNS):
            took, answer = seconds(lambda: output_of(command))
            own.append(took)
        took, expected = seconds(lambda: oracle.analyse(scenario, MAX_SPEED))
        whole.append(took)
        scan.append(oracle.scan["time"])
        done += 1
        if took > LONG:
            rounds = min(rounds, LONG_ROUNDS)
    found = json.loads(answer)["critical"], expected["critical"]
    speeds = [math.nan if one is None else one["speed"] for one in found]
    if (found[0] is None) != (found[1] is None) or abs(speeds[0] - speeds[1]) > AGREEMENT:
        sys.exit(f"the critical speeds differ: {speeds[0]} by Tautline, {speeds[1]} by the oracle")
    return {"size": oracle.scan["size"], "cables": len(scenario["cables"]),
            "elements": scenario["elements_per_cable"], "speed": speeds[0],
            "oracle": statistics.median(whole), "scan": statistics.median(scan), "tautline": statistics.median(own)}


def processor():
    """The processor's name, and how many there are."""
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
        name = next(line.split(":", 1)[1].strip() for line in lines if line.startswith("model name"))
    except (OSError, StopIteration):
        name = platform.processor() or platform.machine()
    return f"{name}, {os.cpu_count()} cores"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--tautline", type=Path, help="the program; it is built where none is given")
    parser.add_argument("--rounds", type=int, default=5, help="rounds per scenario")
    parser.add_argument("--json", type=Path, metavar="FILE", help="write the figures there as well")
    options = parser.parse_args()
    tautline = options.tautline or build()
    oracle = load_oracle()
    start = statistics.median(seconds(lambda: output_of([tautline, "--version"]))[0] for _ in range(21))
    rows = []
    print("| robot | cables × elements | companion | numpy/scipy (ms) | of which scan | Tautline (ms) | ratio |")
    print("|---|---:|---:|---:|---:|---:|---:|")
    with tempfile.TemporaryDirectory() as folder:
        for title, scenario in scenarios(tautline, oracle):
            row = compare(oracle, tautline, scenario, Path(folder) / "scenario.json", max(1, options.rounds))
            rows.append({"robot": title, **row})
            print(f"| {title} | {row['cables']} × {row['elements']} | {row['size']} × {row['size']} "
                  f"| {1e3 * row['oracle']:.0f} | {1e3 * row['scan']:.0f} | {1e3 * row['tautline']:.1f} "
                  f"| {row['oracle'] / row['tautline']:.0f} |", flush=True)
    compiler = subprocess.run(["rustc", "--version"], capture_output=True, text=True, check=False).stdout.split()
    about = {"processor": processor(), "rustc": compiler[1] if len(compiler) > 1 else "unknown",
             "python": platform.python_version(), "numpy": numpy.__version__, "scipy": scipy.__version__,
             "process_start": start}
    print(f"\n{about['processor']}; rustc {about['rustc']}; Python {about['python']}, numpy {about['numpy']}, "
          f"scipy {about['scipy']}, one thread. Of Tautline's times {1e3 * start:.1f} ms are the start of its process.")
    if options.json:
        options.json.write_text(json.dumps({"about": about, "rows": rows}, indent=1) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
