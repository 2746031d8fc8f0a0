"""The comparison with other renderers; README.md beside this file says how it is made fair."""

import argparse
import csv
import os
import pathlib
import resource
import subprocess
import sys

import scenes
import systems

HEAD = ["scene", "kernel", "program", "CPU s", "read s", "build s", "trace s", "times ours",
        "body", "mean error / h", "largest", "judged", "lost", "invented", "other", "dark",
        "bright"]


def run(command, log, limit):
    """Runs a program on one core. CPU seconds, user and system, or what went wrong."""

    def pin():
        os.sched_setaffinity(0, {max(os.sched_getaffinity(0))})

    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    with open(log, "w") as out:
        try:
            code = subprocess.run(list(map(str, command)), stdout=out, stderr=subprocess.STDOUT,
                                  stdin=subprocess.DEVNULL, timeout=limit,
                                  preexec_fn=pin).returncode
        except subprocess.TimeoutExpired:
            return f"> {limit}"
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if code:
        return f"failed ({code})"
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


class Match:
    """One program before one cloud."""

    def __init__(self, system, limit):
        self.system, self.folder, self.limit = system, system.folder, limit
        self.runs = []  # (CPU seconds, (read, build, trace) or None)
        self.failure = ""

    def run(self, kind):
        """Makes a picture; False if none came."""
        log = self.folder / f"{self.system.name}-{kind}.log"
        picture = self.folder / getattr(self.system, kind)
        if kind == "depth" and self.system.depth == self.system.shade:
            return picture.exists()
        picture.unlink(missing_ok=True)
        cpu = run(self.system.command(kind), log, self.limit)
        if isinstance(cpu, str):
            self.failure = cpu
        elif not picture.exists():
            self.failure = "no picture"
        elif kind == "shade":
            self.runs.append((cpu, self.system.seconds(log.read_text(errors="replace"))))
        return not self.failure

    def times(self):
        """Of the run whose CPU time is the median: the total, to read, to build, to trace."""
        if not self.runs:
            return None
        cpu, parts = sorted(self.runs)[(len(self.runs) - 1) // 2]
        return (cpu, *(parts or (0, 0, 0)))


def judge(program, folder, matches, stride):
    """The judge's words on each picture, by program."""
    command = [program, "compare", folder / "cloud", stride, folder / "sheet.png"]
    for match in matches:
        if not match.failure:
            system = match.system
            command += [system.name, folder / system.depth, folder / system.shade]
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True)
    if done.returncode:
        sys.exit(done.stderr)
    return {row["program"]: row for row in csv.DictReader(done.stdout.splitlines())}


def compete(name, cloud, folder, options):
    """All programs that know the cloud's kernel, before it. Rows of the table."""
    folder.mkdir(parents=True, exist_ok=True)
    cloud.cells *= options.finer
    cloud.write(folder / "cloud")
    matches = []
    for make in (systems.Ours, *systems.RIVALS):
        if cloud.kernel in make.kernels and make.name not in options.without:
            system = make(options.build, folder)
            system.prepare(cloud)
            matches.append(Match(system, options.limit))
    for turn in range(options.repeat):  # in turns, so that all meet the same weather
        for match in matches:
            long = match.runs and match.runs[0][0] > 60
            if not match.failure and not (turn and long):
                print(f"{name}, {cloud.kernel}: {match.system.name}", file=sys.stderr)
                match.run("shade")
    for match in matches:
        if not match.failure:
            match.run("depth")
    verdicts = judge(options.build / "bench/rival-judge", folder, matches, options.stride)

    ours = matches[0].times()
    rows = []
    for match in matches:
        row = {"scene": name, "kernel": cloud.kernel, "program": match.system.name,
               "CPU s": match.failure}
        times = match.times()
        if times:
            row.update(zip(HEAD[3:7], (f"{t:.2f}" for t in times)))
        if times and ours:
            row["times ours"] = f"{(times[2] + times[3]) / (ours[2] + ours[3]):.1f}"
        rows.append(row | verdicts.get(match.system.name, {}))
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("counts", nargs="*", type=lambda s: round(float(s)),
                        default=[10 ** 3, 10 ** 4, 10 ** 5],
                        help="numbers of atoms (default 1e3 1e4 1e5)")
    parser.add_argument("--breaks", action="store_true", help="the scenes where programs break")
    parser.add_argument("--only", default="", help="of those, the ones whose name holds this")
    parser.add_argument("--without", nargs="+", default=[], help="programs to leave out",
                        choices=[make.name for make in systems.RIVALS])
    parser.add_argument("--finer", type=float, default=1,
                        help="Blender's cells and OpenVDB's voxels, so many times as fine (1)")
    parser.add_argument("--repeat", type=int, default=3,
                        help="runs of which the median counts (default 3; 1 beyond a minute)")
    parser.add_argument("--limit", type=int, default=900, help="seconds a run may take (900)")
    parser.add_argument("--stride", type=int, default=8,
                        help="every how many-th pixel each way meets the oracle (8)")
    parser.add_argument("--build", type=pathlib.Path, required=True, help="where the programs are")
    parser.add_argument("--out", type=pathlib.Path, required=True, help="where the pictures go")
    options = parser.parse_args()
    if options.breaks:
        options.repeat = 1

    rows = []
    print("| " + " | ".join(HEAD) + " |\n|" + " --- |" * len(HEAD), flush=True)
    for kernel in ("blob", "wyvill"):
        if options.breaks:
            clouds = {name: make for name, make in scenes.breaks(kernel).items()
                      if options.only in name}
        else:
            clouds = {f"{count:,}": scenes.grid(kernel, count) for count in options.counts}
        for name, cloud in clouds.items():
            folder = options.out / f"{name} {kernel}".replace(" ", "-").replace(",", "")
            new = compete(name, cloud, folder, options)
            for row in new:
                print("| " + " | ".join(str(row.get(key, "")) for key in HEAD) + " |", flush=True)
            rows += new
    with open(options.out / "rivals.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, HEAD)
        writer.writeheader()
        writer.writerows(rows)


if __name__ == "__main__":
    main()
