# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes performance.md and its figures from what bench/run.sh measured.

report.py RESULTS DOCS [--quick]: DOCS/performance.md, DOCS/images/performance_*.png. Every number of
the page comes from the files in RESULTS, and so does every word that judges one.
"""
import json
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

ELEMENTS = ["tet4", "tet4-star"]
COLOUR = {"tet4": "#555555", "tet4-star": "#0b7a4b"}
STAGES = ["mesh", "assemble", "factor", "step", "basis"]
WANTED = {"whole run": 2.5, "no frames": 1.5, "variants": 8, "assembly": 15e-3, "bound": 2, "read-out": 50e-3, "edit": {"tet4": 0.3, "tet4-star": 0.3}}


def time(s):
    if s is None:
        return "-"
    if s < 1e-3:
        return f"{1e6 * s:.0f} us"
    return f"{1e3 * s:.3g} ms" if s < 1 else f"{s:.3g} s"


def size(b):
    if b is None:
        return "-"
    return f"{b / 2**20:.3g} MiB" if b < 2**30 else f"{b / 2**30:.3g} GiB"


def rate(r):
    return f"{1e-9 * r:.1f} GB/s"


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return "\n".join(lines + ["| " + " | ".join(str(c) for c in row) + " |" for row in rows]) + "\n"


def verdict(value, wanted):
    return "met" if value <= wanted else f"missed: {value / wanted:.2g} times"


def stamp(results, part):
    """"on DATE at commit COMMIT", as bench/run.sh wrote it."""
    return (results / f"{part}.txt").read_text().strip()


def sentence_on_machine(results, solver, quick):
    m = solver["machine"]
    caches = ", ".join(f"L{c['level']} {size(c['bytes'])}" for c in m["caches"])
    case = solver["case"]
    text = f"""# Performance

Written by `make bench` {stamp(results, 'all')}: every number below comes from
that run, none is typed. {"**A quick look: few repeats, no large meshes.** " if quick else ""}Medians unless said otherwise.

{m["processor"]}, {m["cores"]} cores, {caches}, {size(m["memory_bytes"])} of memory; load average
{m["load_before"]:.1f} as this part began. Measured on: {case["name"]} ({case["nodes"]} nodes,
{case["tets"]} tetrahedra, {case["steps"]} steps of {1e3 * case["dt_s"]:g} ms).

How fast this machine reads (best of several passes, widest vectors):

"""
    rows = [[t + 1, rate(m["read_memory"][t]), rate(m["read_cache"][t])]
            for t in range(len(m["read_memory"]))]
    return text + table(["threads", f"memory ({size(m['memory_test_bytes'])})",
                         f"cache ({size(m['cache_test_bytes'])})"], rows)


def assembly_times(results):
    """(name, element, threads) -> seconds, medians of the repetitions."""
    out = {}
    for b in json.loads((results / "assembly.json").read_text())["benchmarks"]:
        if b.get("aggregate_name") != "median":
            continue
        parts = b["run_name"].split("/")
        threads = int(parts[2]) if parts[0] == "reassemble" else 0
        out[parts[0], ELEMENTS[int(parts[1])], threads] = 1e-3 * b["real_time"]
    return out


def bounds(solver, element):
    """Per entry of steps: seconds to read the factor twice from memory, from cache, as it lies."""
    m, e = solver["machine"], solver["elements"][element]
    twice = 2 * e["bytes"]
    return [{"memory": twice / m["read_memory"][s["threads"] - 1],
             "cache": twice / m["read_cache"][s["threads"] - 1],
             "like": twice / s["read_like_factor"]} for s in e["steps"]]


def summary(solver, reduced, assembly):
    rows = []
    for e in ELEMENTS:
        threads = max(t for n, k, t in assembly if (n, k) == ("reassemble", e))
        s = assembly["reassemble", e, threads]
        rows.append([f"re-assembly, {solver['case']['tets']} elements", e, time(s),
                     time(WANTED["assembly"]), verdict(s, WANTED["assembly"])])
    for e in ELEMENTS:
        step, bound = solver["elements"][e]["steps"][-1], bounds(solver, e)[-1]
        ratio = step["step_s"] / bound["memory"]
        rows.append(["step of the full model over the memory bound", e,
                     f"{ratio:.2g} ({time(step['step_s'])})", WANTED["bound"],
                     verdict(ratio, WANTED["bound"])])
    for e in ELEMENTS:
        edit = reduced["elements"][e]["edit"]
        rows.append([f"reading out {edit['frames']} frames of the skin", e, time(edit["again_s"]),
                     time(WANTED["read-out"]), verdict(edit["again_s"], WANTED["read-out"])])
    for e in ELEMENTS:
        s = reduced["elements"][e]["edit"]["total_s"]
        rows.append(["edit of the tissue to all frames of the skin", e, time(s), time(WANTED["edit"][e]),
                     verdict(s, WANTED["edit"][e])])
    for e in ELEMENTS:
        for problem in ("motion", "hard"):
            for r in reduced["elements"][e][problem]["rows"]:
                if r["tolerance"] == 1e-3:
                    rows.append([f"true error of the reduced model, {problem}", e,
                                 f"{r['true_error']:.1e}", f"{r['tolerance']:g}",
                                 verdict(r["true_error"], r["tolerance"])])
    return "\n## What was wanted\n\n" + table(["", "element", "measured", "wanted", ""], rows)


def assembly_section(assembly):
    text = """
## Assembly
Stiffness, damping and mass: for a new mesh (shapes and patterns too), and for other tissue values on
patterns that are kept.

"""
    rows = []
    for e in ELEMENTS:
        rows.append([e, time(assembly["assemble_anew", e, 0])] +
                    [time(assembly["reassemble", e, t]) for t in (1, 2)])
    return text + table(["element", "new mesh", "again, 1 thread", "again, 2 threads"], rows)


def factor_section(solver):
    rows = []
    for name in ELEMENTS:
        e = solver["elements"][name]
        rows.append([name, e["free_unknowns"], time(e["analyse_s"]), time(e["refactor_s"]),
                     f"{1e-9 * e['flops'] / e['refactor_s']:.1f}", f"{1e-6 * e['entries']:.2f} M",
                     size(e["bytes"]), time(e["refill_s"])])
    text = """
## Factor
The matrix of a time step on the free unknowns, factored by CHOLMOD in supernodes (METIS ordering).
"Other values": all that new tissue values take before the next step (sums, factor, copies).

"""
    return text + table(["element", "unknowns", "ordering and analysis", "factor again", "GFlop/s",
                         "entries of L", "in memory", "other values"], rows)


def step_section(solver):
    rows = []
    for name in ELEMENTS:
        e = solver["elements"][name]
        for s, b in zip(e["steps"], bounds(solver, name)):
            rest = max(0, s["step_s"] - s["solve_s"] - s["product_s"] - s["coupling_s"])
            rows.append([name, s["threads"], f"{s['cores_busy']:.2f}", f"**{time(s['step_s'])}**", time(s["solve_s"]),
                         time(s["product_s"]), time(s["coupling_s"]), time(rest),
                         *[f"{time(b[k])} ({s['step_s'] / b[k]:.1f})"
                           for k in ("memory", "like", "cache")]])
    text = """
## A step of the full model
`Newmark::step` with the face's motion, and its parts in the order of a step: both triangular solves, the
product with mass and damping, the product with the prescribed displacements, and the rest of the step. The
bound is the time to read the factor twice, which no solver with this factor can beat. It is given at the
rate of memory, of an array as large as the factor, and of the cache, with the step over the bound in
brackets. A factor that fits into the last cache may be faster than the bound of memory. "Cores busy" is
processor time over elapsed time. If two threads keep no more than one core busy, other programs used the
second core, and the row says nothing about two threads.

"""
    text += table(["element", "threads", "cores busy", "step", "solves", "M and C", "K_oc", "rest", "bound: memory",
                   "as large", "cache"], rows)
    text += "\n![Parts of a step](images/performance_step.png)\n"
    return text + trials(solver) + calculix_section(solver)


def trials(solver):
    text = """
### What helps and what does not
Ordering, each solved by the library's kernel and by CHOLMOD's own (`cholmod_solve2`), one
right-hand side:

"""
    rows = []
    for name in ELEMENTS:
        for o in solver["elements"][name]["orderings"]:
            rows.append([name, o["ordering"], time(o["analyse_s"]), time(o["factor_s"]),
                         f"{1e-6 * o['entries']:.2f} M", time(o["own_solve_s"]),
                         time(o["cholmod_solve_s"]),
                         f"{o['cholmod_solve_s'] / o['own_solve_s']:.2f}"])
    text += table(["element", "ordering", "analysis", "factor", "entries", "library", "CHOLMOD",
                   "CHOLMOD / library"], rows)
    text += """
Numbers of the factor in single precision, an experiment of the benchmark: the same kernel in both
types, solving steps of the motion again. "Refined" solves once more for what is left; "the change"
solves for the difference to d + h v + h^2/2 a alone, which takes one product with A. Bytes are what a
solve reads at least; the error is the greatest of any unknown over the greatest displacement.

"""
    rows = []
    for name in ELEMENTS:
        types = solver["elements"][name]["number_types"]
        for t in types:
            rows.append([name, t["name"], time(t["seconds"]), size(t["bytes"]), f"{t['error']:.0e}",
                         f"{types[0]['seconds'] / t['seconds']:.2f}"])
    text += table(["element", "numbers", "a solve", "reads", "error", "times as quick"], rows)
    text += "\nSeveral right-hand sides together (CHOLMOD's dense blocks), time for each of them:\n\n"
    columns = [s["columns"] for s in solver["elements"][ELEMENTS[0]]["several"]]
    rows = [[name] + [time(s["solve_s"] / s["columns"])
                      for s in solver["elements"][name]["several"]] for name in ELEMENTS]
    return text + table(["element"] + [f"{c}" for c in columns], rows)


def calculix_section(solver):
    ccx = solver["calculix"]
    if not ccx:
        return "\n### CalculiX\nNot installed where this ran (`scripts/setup.sh --bench`).\n"
    own = solver["elements"]["tet4"]["steps"][-1]["step_s"]
    return f"""
### CalculiX
The same mesh of linear tetrahedra, the same nodes driven and fixed (without the elastic foundations), and
implicit dynamics with Rayleigh damping. On two threads, in the same run: {ccx["few"]} steps in
{time(ccx["few_s"])}, {ccx["many"]} steps in {time(ccx["many_s"])}. The difference is
**{time(ccx["step_s"])} a step, {ccx["step_s"] / own:.0f} times ours** ({time(own)}). It also writes the displacements of all nodes at each step.
"""


def reduced_section(reduced):
    rows, edit = [], []
    for name in ELEMENTS:
        e = reduced["elements"][name]
        d = e["edit"]
        rows.append([name, e["input_shapes"], e["basis_size"], time(e["basis_s"])])
        edit.append([name, time(d["assemble_s"]), time(d["refactor_s"]), time(d["basis_s"]),
                     time(d["again_s"]), f"**{time(d['total_s'])}**"])
    text = """
## The reduced model
At the default tolerance:

"""
    text += table(["element", "input shapes", "basis", "made in"], rows)
    text += f"""
From an edit of the tissue's values to all {d["frames"]} frames of the {d["skin_vertices"]} vertices of the skin, through the
`Simulator` that programs use: `set_tissue` and `run` (matching, patterns and ordering are kept). "Read out": the
same run once more with nothing changed, which is skin, landmarks, lips and inverted elements of all frames.

"""
    text += table(["element", "assembly", "factor", "basis", "read out", "together"], edit)
    text += """
Requested tolerance, estimated error and true error. The true error is the greatest distance of any node
in any step from the full model, driven by the complete motion, over the greatest displacement. "Hard": the
motion's peak times a sine of 0.27 s, with a tenth of the viscosity, from rest to full speed within the
first steps.

"""
    rows = []
    for name in ELEMENTS:
        for problem in ("motion", "hard"):
            for r in reduced["elements"][name][problem]["rows"]:
                rows.append([name, problem, f"{r['tolerance']:.0e}", r["input_shapes"],
                             r["basis_size"], r["passes"], time(r["basis_s"]),
                             f"{r['estimated_error']:.1e}" + ("" if r["converged"] else " (stopped)"),
                             f"{r['true_error']:.1e}", r["worst_step"]])
    text += table(["element", "problem", "tolerance", "shapes", "basis", "passes", "time",
                   "estimated", "true", "worst at step"], rows)
    return text + "\n![Errors against the size of the basis](images/performance_reduced.png)\n"


def tracking_section(results):
    text = """
## Tracking
`hyperex track` on recordings of 640 x 480 pixels, by stage, in milliseconds per frame, on one core, the
fastest of three passes. "From memory": the pictures are decoded before. "With decoding": they are read from
JPEG and PNG during the pass. "And a scan": all vertices of a scan follow the tracked triangles too, as a
measured region does. "Cores busy" is processor time over elapsed time. The person's face shape is estimated
once.

"""
    if not (results / "tracking.json").exists():
        return text + "Not measured: no recordings lay beside the checkout.\n"
    if stamp(results, "tracking") != stamp(results, "all"):
        text += f"Measured {stamp(results, 'tracking')}.\n\n"
    rows, speeds = [], []
    for r in json.loads((results / "tracking.json").read_text())["recordings"]:
        name = r["name"] or "recording"
        d = r["decoded"]
        rows.append([name, d["frames"], *[f"{1e3 * s:.2f}" for s in
                     (r["decode_s"], d["network_s"], d["pictures_s"], d["fit_s"],
                      r["with_scan"]["follow_s"])], f"{1e3 * d['neutral_once_s']:.0f}"])
        for label, key, wanted in (("from memory", "decoded", 60), ("with decoding", "with_decoding", 30),
                                   (f"and a scan of {r['scan_vertices']} vertices", "with_scan", 30)):
            p = r[key]
            speeds.append([name, label, f"**{p['frames_per_s']:.0f}**", f"{p['cores_busy']:.2f}", wanted,
                           "met" if p["frames_per_s"] >= wanted else "missed"])
    text += table(["recording", "frames", "decoding", "network", "pictures", "fit", "scan follows",
                   "shape, once"], rows)
    return text + "\n" + table(["recording", "", "frames a second", "cores busy", "wanted", ""], speeds)


def whole_run_section(results):
    """A run of the command with all of its outputs; empty where it was not measured."""
    if not (results / "whole_run.json").exists():
        return ""
    r = json.loads((results / "whole_run.json").read_text())
    text = f"""## A whole run
`hyperex run {r['scene']}`, the command itself with all of its outputs, measured by
`bench/whole_run.py`: the median of {r['first']['runs']}. "First": the cache folder is empty, and landmarks are looked for on
the scan, to check those given. "Again": what the first run found is taken from there. "Processor" is
the time of all cores together.

"""
    if stamp(results, "whole_run") != stamp(results, "all"):
        text += f"Measured {stamp(results, 'whole_run')}.\n\n"
    rows = []
    for key, name, wanted in (("first", "first", "whole run"), ("again", "again", "whole run"),
                              ("first_no_frames", "first, without frames for ParaView", "no frames"),
                              ("again_no_frames", "again, without frames for ParaView", "no frames")):
        one = r[key]
        rows.append([name, f"**{time(one['wall_s'])}**", time(one["processor_s"]),
                     time(one["spread_s"]), size(one["bytes"]), time(WANTED[wanted]),
                     verdict(one["wall_s"], WANTED[wanted])])
    text += table(["run", "time", "processor", "least to most", "files", "wanted", ""], rows)
    rows = []
    for by in ("muscles", "displacement"):
        v = r[f"variants_{by}"]
        wanted = WANTED["variants"] * v["count"] / 30
        for many, one, name in (("all", "one", "first"), ("all_again", "one_again", "again")):
            ratio = v[many]["wall_s"] / v[one]["wall_s"]
            rows.append([f"driven by {by}, {name}", time(v[many]["wall_s"]), time(v[many]["processor_s"]),
                         time(v[one]["wall_s"]), f"**{ratio:.1f}**", f"{wanted:g}", verdict(ratio, wanted)])
    return text + f"""
With {v['count']} variants of the stiffness, their pictures, tables and models, beside one run of the same scene
without them:

""" + table(["run", "with variants", "processor", "without", "ratio", "wanted", ""], rows) + "\n"


def memory_section(results):
    if not (results / "memory.json").exists():
        return ""
    r = json.loads((results / "memory.json").read_text())
    rows = [[f"driven by {by}", m["nodes"], size(m["early_bytes"]), size(m["late_bytes"]), f"**{m['ratio']:.3f}**",
             m["most"], verdict(m["ratio"], m["most"])] for by, m in r.items()]
    early, late = (r["displacement"][k] for k in ("early_cycles", "late_cycles"))
    return f"""
## Memory
Resident memory of `memory_bench` after {early} and {late} cycles of `set_tissue()` and `run()`.

""" + table(["small face", "nodes", f"after {early}", f"after {late}", "ratio", "wanted", ""], rows)


def growth_rows(results):
    return [json.loads(f.read_text()) for f in sorted(results.glob("growth_*.json"))]


def growth_section(rows):
    text = """
## Growth
The embedded face in smaller elements and more layers, a process each. Time and greatest memory of each
stage; the full model's and the reduced model's factor are not in memory together. Address space is
limited to 20 GiB.

"""
    out = []
    for element in ELEMENTS:
        for r in sorted((r for r in rows if r["element"] == element), key=lambda r: r.get("nodes", 0)):
            stages = r.get("stages", {})
            cells = []
            for s in STAGES:
                done = stages.get(s)
                stopped = r.get("stopped_at") == s
                cells.append(f"{time(done['seconds'])}, {size(done['peak_bytes'])}" if done
                             else "stopped here" if stopped else "-")
            out.append([element, r.get("nodes", "-"), r.get("free_unknowns", "-"), *cells,
                        size(r.get("factor_bytes")), r.get("basis_size", "-"),
                        size(r.get("peak_bytes"))])
    text += table(["element", "nodes", "unknowns", "mesh", "assembly", "factor", "step", "basis",
                   "factor's size", "basis vectors", "greatest memory"], out)
    for r in rows:
        if "failed" in r:
            text += f"\n{r['element']}, {r.get('nodes', '?')} nodes: {r['failed']}.\n"
    return text + "\n![Time and memory against the number of nodes](images/performance_growth.png)\n"


def plot_step(solver, out):
    figure, ax = plt.subplots(figsize=(9, 3.4))
    labels, left = [], []
    for name in ELEMENTS:
        for s, b in zip(solver["elements"][name]["steps"], bounds(solver, name)):
            y = len(labels)
            labels.append(f"{name}, {s['threads']} thread{'s' * (s['threads'] > 1)}")
            at = 0
            rest = max(0, s["step_s"] - s["solve_s"] - s["product_s"] - s["coupling_s"])
            for part, colour, seconds in (("triangular solves", "#0b7a4b", s["solve_s"]),
                                          ("M and C", "#1f77b4", s["product_s"]),
                                          ("rest", "#bbbbbb", s["coupling_s"] + rest)):
                ax.barh(y, 1e3 * seconds, left=at, color=colour, label=part if y == 0 else None)
                at += 1e3 * seconds
            for key, style in (("memory", "-"), ("like", ":")):
                ax.plot([1e3 * b[key]] * 2, [y - 0.45, y + 0.45], style, color="#d62728",
                        label={"memory": "bound, memory", "like": "bound, array as large"}[key]
                        if y == 0 else None)
            left.append(y)
    ax.set_yticks(left, labels)
    ax.invert_yaxis()
    ax.set_xlabel("ms a step")
    ax.legend(frameon=False, fontsize=8, loc="center left", bbox_to_anchor=(1, 0.5))
    ax.grid(alpha=0.3, axis="x")
    figure.tight_layout()
    figure.savefig(out, dpi=100)
    plt.close(figure)


def plot_reduced(reduced, out):
    figure, axes = plt.subplots(1, 2, figsize=(9.5, 4), sharey=True)
    for ax, problem in zip(axes, ("motion", "hard")):
        for name in ELEMENTS:
            rows = reduced["elements"][name][problem]["rows"]
            sizes = [r["basis_size"] for r in rows]
            for key, style in (("true_error", "o-"), ("estimated_error", "x:")):
                ax.loglog(sizes, [r[key] for r in rows], style, color=COLOUR[name],
                          label=f"{name}, {key.split('_')[0]}")
            ax.loglog(sizes, [r["tolerance"] for r in rows], "--", color=COLOUR[name], alpha=0.35,
                      label=f"{name}, asked for")
        ax.set_title("mouth opening" if problem == "motion" else "hard case", fontsize=10)
        ax.set_xlabel("vectors of the basis")
        ax.grid(alpha=0.3, which="both", linewidth=0.5)
    axes[0].set_ylabel("error over the greatest displacement")
    axes[0].legend(frameon=False, fontsize=8)
    figure.tight_layout()
    figure.savefig(out, dpi=100)
    plt.close(figure)


def plot_growth(rows, out):
    figure, axes = plt.subplots(1, 2, figsize=(10, 4.6))
    colours = dict(zip(STAGES, ("#c66a00", "#1f77b4", "#d62728", "#0b7a4b", "#9b59b6")))
    for element, style in (("tet4", "s--"), ("tet4-star", "o-")):
        own = sorted((r for r in rows if r["element"] == element and "nodes" in r),
                     key=lambda r: r["nodes"])
        for stage in STAGES:
            some = [(r["nodes"], r["stages"][stage]) for r in own if stage in r["stages"]]
            axes[0].loglog([n for n, _ in some], [s["seconds"] for _, s in some], style,
                           color=colours[stage], markersize=4, label=f"{stage}, {element}")
        axes[1].loglog([r["nodes"] for r in own], [r["peak_bytes"] / 2**30 if "peak_bytes" in r
                                                   else float("nan") for r in own],
                       style, color=COLOUR[element], label=f"greatest memory, {element}")
        some = [r for r in own if "factor_bytes" in r]
        axes[1].loglog([r["nodes"] for r in some], [r["factor_bytes"] / 2**30 for r in some], style,
                       color=COLOUR[element], alpha=0.4, label=f"factor, {element}")
    axes[0].set_ylabel("seconds")
    axes[1].set_ylabel("GiB")
    for ax in axes:
        ax.set_xlabel("nodes")
        ax.grid(alpha=0.3, which="both", linewidth=0.5)
        ax.legend(frameon=False, fontsize=7)
    figure.tight_layout()
    figure.savefig(out, dpi=100)
    plt.close(figure)


def main():
    results, docs = Path(sys.argv[1]), Path(sys.argv[2])
    images = docs / "images"
    images.mkdir(parents=True, exist_ok=True)
    solver = json.loads((results / "solver.json").read_text())
    reduced = json.loads((results / "reduced.json").read_text())
    assembly, growth = assembly_times(results), growth_rows(results)
    page = sentence_on_machine(results, solver, "--quick" in sys.argv) + summary(solver, reduced, assembly)
    page += assembly_section(assembly) + factor_section(solver) + step_section(solver)
    page += whole_run_section(results) + reduced_section(reduced) + tracking_section(results)
    page += memory_section(results) + growth_section(growth)
    (docs / "performance.md").write_text(page)
    plot_step(solver, images / "performance_step.png")
    plot_reduced(reduced, images / "performance_reduced.png")
    plot_growth(growth, images / "performance_growth.png")


if __name__ == "__main__":
    main()
