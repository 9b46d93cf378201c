"""The results as plain text: ratios first, each with what it is a ratio of."""

from collections.abc import Container
from typing import Any


def render(results: dict[str, Any], failed: Container[str] = ()) -> str:
    """Return the tables of what bench/results.json holds, in 80 columns.

    Args:
        results: {part: what it measured}, and "about".
        failed: parts that failed now; what is known of them is marked as old.
    """
    about = results["about"]
    lines = [f"{about['date']}, {about['machine']}"]
    tools = ("python", "mujoco", "numpy", "pin")
    lines.append(", ".join(f"{name} {about[name]}" for name in tools if name in about))
    parts = {
        "fk": _fk,
        "ik": _ik,
        "dynamics": _dynamics,
        "lab": _lab,
        "growth": _growth,
        "metrics": _metrics,
        "checker": _checker,
        "tests": _tests,
        "first-minute": _first_minute,
    }
    for name, table in parts.items():
        if name in results:
            lines += ["", *table(results[name])]
            if name in failed:
                lines.append("  OLD: this part failed now, these are its last numbers")
            left_out = results[name].get("left_out", {}).items()
            lines += [f"  left out: {rival} ({why})" for rival, why in left_out]
    return "\n".join(lines)


def _fk(fk: dict[str, Any]) -> list[str]:
    rows = fk["rows"]
    ours = rows["robo47 fk"]["us"]
    lines = [
        f"Forward kinematics of the Panda, {fk['n']:,} configurations, one thread",
        f"  {'':32}  {'us each':>8}  {'ours /':>6}  {'spread':>13}  {'error':>7}",
    ]
    for name, row in sorted(rows.items(), key=lambda item: item[1]["us"]):
        low, high = (
            f"{x:.0f}" if x > 99 else f"{x:.3g}" for x in (row["low"], row["high"])
        )
        spread = f"{low}..{high}"
        lines.append(
            f"  {name:32}  {row['us']:8.3f}  {ours / row['us']:6.3f}"
            f"  {spread:>13}  {row['error']:7.0e}"
        )
    return lines


def _ik(ik: dict[str, Any]) -> list[str]:
    rows = ik["rows"]
    ours = rows["robo47 solve_ik"]["us"]
    lines = [
        f"Inverse kinematics, {ik['n']:,} random targets, to 1e-8, one thread",
        f"  {'':33}  {'us each':>7}  {'ours /':>6}  {'solved':>9}  {'within':>6}"
        f"  {'steps':>5}",
    ]
    for name, row in sorted(rows.items(), key=lambda item: item[1]["us"]):
        solved = f"{row['solved']}/{row['targets']}"
        lines.append(
            f"  {name:33}  {row['us']:7.0f}  {ours / row['us']:6.3f}  {solved:>9}"
            f"  {row['within']:6}  {row['steps']:5.1f}"
        )
    return lines


def _dynamics(dynamics: dict[str, Any]) -> list[str]:
    lines = [f"Dynamics of the Panda, {dynamics['n']:,} configurations, one thread"]
    for question, rows in dynamics["questions"].items():
        ours = rows["robo47 batch"]["us"]
        lines.append(f"  {question:32}  {'us each':>8}  {'ours /':>6}  {'error':>7}")
        lines += [
            f"    {name:30}  {row['us']:8.3f}  {ours / row['us']:6.3f}"
            f"  {row['error']:7.0e}"
            for name, row in sorted(rows.items(), key=lambda item: item[1]["us"])
        ]
    lines.append("  one configuration at a time, us")
    return lines + [f"    {what:30}  {us:8.1f}" for what, us in dynamics["one"].items()]


def _lab(lab: dict[str, Any]) -> list[str]:
    seconds = lab["seconds"]
    handout = seconds.get("the handout's script, fixed")
    lines = ["The lab, warm, as whole processes", f"  {'':38}  {'s':>5}  / handout's"]
    for name, t in sorted(seconds.items(), key=lambda item: item[1]["median"]):
        ratio = f"{t['median'] / handout['median']:8.2f}" if handout else ""
        lines.append(f"  {name:38}  {t['median']:5.2f}  {ratio}")
    return lines


def _growth(growth: dict[str, Any]) -> list[str]:
    counts = {f"1e{len(n) - 1}": us for n, us in growth["by_count"].items()}
    return [
        "How it grows, us per configuration",
        *_two_rows("configurations", counts),
        *_two_rows("joints", growth["by_joints"]),
        f"  memory beyond input and output at most {growth['memory_mb']:.1f} MB",
    ]


def _two_rows(label: str, points: dict[str, float]) -> list[str]:
    return [
        f"  {label:14}" + "".join(f"{n:>6}" for n in points),
        f"  {'':14}" + "".join(f"{us:6.2g}" for us in points.values()),
    ]


def _metrics(metrics: dict[str, Any]) -> list[str]:
    empty, long = metrics["rows"]
    lines = [
        "One row of the metrics log",
        f"  {'':28}  us at {empty} rows  us at {long:,}  / naive",
    ]
    for name, (first, last) in metrics["median_us"].items():
        ratio = metrics["times_naive"][name][1]
        lines.append(f"  {name:28}  {first:12.0f}  {last:15,.0f}  {ratio:7.1f}")
    return lines


def _checker(checker: dict[str, Any]) -> list[str]:
    return [
        "The checker, whole processes",
        *(f"  {name:38}  {t['median']:5.2f} s" for name, t in checker.items()),
    ]


def _tests(tests: dict[str, Any]) -> list[str]:
    return [
        f"make test: {tests['passed']} tests, {tests['seconds']:.0f} s; the slowest",
        *(f"  {line}" for line in tests["slowest"]),
    ]


def _first_minute(first: dict[str, Any]) -> list[str]:
    got = first["downloaded_mb"]
    end = "to All checks PASSED" if first["passed"] else "until it FAILED"
    return [
        "The first minute: git clone and make day1, nothing cached",
        f"  {first['seconds']:.0f} s {end}"
        + (f", {got:.0f} MB downloaded in all" if got is not None else ""),
        f"  {first['robot_mb']:.1f} MB of it for the robot;"
        f" the handout clones {first['handout_clone_mb']} MB",
    ]
