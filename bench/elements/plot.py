# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures and tables of docs/elements.md from the CSV files of elements_study.

plot.py RESULTS DOCS: writes DOCS/images/elements_*.png and renews the tables between the markers
<!-- table NAME --> and <!-- end --> in DOCS/elements.md.
"""
import csv
import re
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.collections import PolyCollection
from matplotlib.ticker import NullFormatter

CHOSEN = "disjoint stars, packed"
SHOWN = {  # name -> colour, marker
    "tet4": ("#555555", "s"),
    "stars, kept 0": ("#c66a00", "v"),
    "stars, kept 2": ("#e8b060", "^"),
    "patches of 4": ("#9b59b6", "<"),
    "patches of 8": ("#c39bd3", ">"),
    CHOSEN: ("#0b7a4b", "o"),
    "P1-P1 projected": ("#1f77b4", "D"),
    "P2-P0": ("#d62728", "*"),
}
LABEL = {"stars, kept 0": "node averages", CHOSEN: "disjoint stars (tet4-star)",
         "P1-P1 projected": "P1-P1, pressure projected", "P2-P0": "quadratic, P2-P0"}
LEGEND = 0.6  # inches below the axes
POISSON = ["0.3", "0.495", "0.4999"]


def read(folder, name):
    with open(folder / f"{name}.csv") as file:
        return list(csv.DictReader(file))


def label(name):
    if name in LABEL:
        return LABEL[name]
    kept = re.fullmatch("stars, kept (.*)", name)
    return f"node averages, {kept[1]} mu kept" if kept else name.replace("patches", "METIS patches")


def convergence(rows, against, x_label, out):
    titles = {"cook": "Cook's membrane", "beam": "bent beam", "sphere": "inflated sphere"}
    figure, axes = plt.subplots(3, 3, figsize=(11, 10), sharey="row")
    for i, (problem, title) in enumerate(titles.items()):
        for j, nu in enumerate(POISSON):
            ax = axes[i][j]
            for name, (colour, marker) in SHOWN.items():
                line = [r for r in rows if r["problem"] == problem and r["poisson"] == nu
                        and r["candidate"] == name]
                ax.loglog([against(r) for r in line], [float(r["error"]) for r in line],
                          marker=marker, color=colour, label=label(name), markersize=5,
                          linewidth=2.4 if name == CHOSEN else 1.1,
                          zorder=3 if name == CHOSEN else 2)
            ax.set_title(f"{title}, nu = {nu}", fontsize=10)
            ax.grid(alpha=0.3, which="both", linewidth=0.5)
            ax.yaxis.set_minor_formatter(NullFormatter())
            if i == 2:
                ax.set_xlabel(x_label)
            if j == 0:
                ax.set_ylabel("relative error of displacement")
    handles, names = axes[0][0].get_legend_handles_labels()
    figure.legend(handles, names, loc="lower center", ncol=4, frameon=False)
    figure.tight_layout(rect=(0, LEGEND / figure.get_figheight(), 1, 1))
    figure.savefig(out, dpi=100)
    plt.close(figure)


def pressure(rows, out):
    names = ["tet4", "stars, kept 0", "patches of 4", "patches of 8", CHOSEN, "P1-P1 projected"]
    figure, axes = plt.subplots(2, 3, figsize=(11, 7.8))
    for ax, name in zip(axes.flat, names):
        own = [r for r in rows if r["candidate"] == name]
        shapes = [[(float(r[f"x{k}"]), float(r[f"y{k}"])) for k in range(3)] for r in own]
        # One scale for all: what the tet4 shows beyond it is not pressure.
        faces = PolyCollection(shapes, array=[float(r["pressure"]) for r in own], cmap="RdBu_r",
                               clim=(-20, 20), edgecolors="face", linewidths=0.2)
        ax.add_collection(faces)
        ax.set_title(label(name), fontsize=10)
        ax.set_aspect("equal")
        ax.autoscale_view()
        ax.set_axis_off()
    figure.subplots_adjust(left=0.01, right=0.9, bottom=0.01, top=0.95, wspace=0.02, hspace=0.1)
    figure.colorbar(faces, cax=figure.add_axes((0.92, 0.2, 0.02, 0.6)), label="pressure",
                    extend="both")
    figure.savefig(out, dpi=100)
    plt.close(figure)


def layer(rows, face, out):
    fill = {r["candidate"]: float(r["factor_entries"]) for r in face}
    figure, axes = plt.subplots(1, 3, figsize=(11, 4.6), sharey=True)
    for ax, nu in zip(axes, POISSON):
        for r in rows:
            if (r["poisson"], r["cells"], r["levels"]) != (nu, "20", "2"):
                continue
            name = r["candidate"]
            colour, marker = SHOWN.get(name, ("#bbbbbb", "."))
            ax.loglog(fill[name] / fill["tet4"], float(r["error"]), marker=marker, color=colour,
                      linestyle="", markersize=9 if name == CHOSEN else 7,
                      label=label(name) if name in SHOWN else None)
        ax.set_title(f"nu = {nu}", fontsize=10)
        ax.set_xlabel("entries of the factor (face) / tet4's")
        ax.set_xticks([1, 2, 4, 8, 16], ["1", "2", "4", "8", "16"])
        ax.set_yticks([0.05, 0.1, 0.2, 0.5, 1, 2], ["0.05", "0.1", "0.2", "0.5", "1", "2"])
        ax.minorticks_off()
        ax.grid(alpha=0.3, linewidth=0.5)
    axes[0].set_ylabel("relative error of the surface's displacement")
    handles, names = axes[0].get_legend_handles_labels()
    figure.legend(handles, names, loc="lower center", ncol=4, frameon=False)
    figure.tight_layout(rect=(0, LEGEND / figure.get_figheight(), 1, 1))
    figure.savefig(out, dpi=100)
    plt.close(figure)


def inf_sup(rows, out):
    figure, axes = plt.subplots(1, 2, figsize=(11, 4.6), sharey=True)
    shown = {**SHOWN, "patches of 12": ("#d9b3e6", "p"), "patches of 24": ("#e3c7ee", "h")}
    for ax, mesh in zip(axes, ("cube", "irregular cube")):
        for name, (colour, marker) in shown.items():
            line = [r for r in rows if r["candidate"] == name and r["mesh"] == mesh]
            if line and name != "tet4":
                ax.loglog([1 / float(r["cells"]) for r in line],
                          [float(r["constant"]) for r in line], marker=marker, color=colour,
                          label=label(name), linewidth=2.4 if name == CHOSEN else 1.1)
        ax.set_title({"cube": "cells cut in six", "irregular cube": "Delaunay, scattered points"}[mesh],
                     fontsize=10)
        ax.set_xlabel("edge / side of the cube")
        ax.set_xticks([1 / 8, 1 / 6, 1 / 4, 1 / 3], ["1/8", "1/6", "1/4", "1/3"])
        ax.xaxis.set_minor_formatter(NullFormatter())
        ax.grid(alpha=0.3, linewidth=0.5)
    axes[0].set_ylabel("numerical inf-sup constant")
    handles, names = axes[0].get_legend_handles_labels()
    figure.legend(handles, names, loc="lower center", ncol=4, frameon=False)
    figure.tight_layout(rect=(0, LEGEND / figure.get_figheight(), 1, 1))
    figure.savefig(out, dpi=100)
    plt.close(figure)


def table(head, lines):
    text = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return "\n".join(text + ["| " + " | ".join(line) + " |" for line in lines])


def bold(name, cells):
    return [f"**{c}**" for c in cells] if name == CHOSEN else cells


def layer_table(rows):
    lines = []
    names = list(dict.fromkeys(r["candidate"] for r in rows))
    for name in names:
        line = [label(name)]
        for levels in ("2", "4"):
            for nu in POISSON:
                own = [r for r in rows if (r["candidate"], r["poisson"], r["cells"], r["levels"])
                       == (name, nu, "20", levels)]
                line.append(f"{float(own[0]['error']):.3f}")
        jump = [r for r in rows if (r["candidate"], r["poisson"], r["cells"], r["levels"])
                == (name, "0.4999", "20", "2")]
        line.append(f"{float(jump[0]['pressure_jump']):.2f}")
        lines.append(bold(name, line))
    return table(["candidate"] + [f"{n} levels, nu {nu}" for n in (2, 4) for nu in POISSON]
                 + ["jump of pressure, 2 levels, nu 0.4999"], lines)


def face_table(rows):
    plain = next(r for r in rows if r["candidate"] == "tet4")
    lines = []
    for r in rows:
        if "kept" in r["candidate"] and r["candidate"] != "stars, kept 0":
            continue  # the same pattern
        assemble = float(r["assemble_s"])
        lines.append(bold(r["candidate"], [
            label(r["candidate"]), r["unknowns"], f"{float(r['factor_entries']) / 1e6:.2f}",
            f"{float(r['factor_entries']) / float(plain['factor_entries']):.2f}",
            f"{1e3 * assemble:.1f}" if assemble else "-",
            f"{1e3 * float(r['analyse_s']):.0f}", f"{1e3 * float(r['factor_s']):.0f}",
            f"{1e3 * float(r['solve_s']):.1f}"]))
    return table(["candidate", "unknowns", "entries of L (million)", "over tet4", "assemble again, two cores (ms)",
                  "analyse (ms)", "factor (ms)", "solve (ms)"], lines)


def finest(rows, problem, nu, name, key):
    own = [r for r in rows if (r["problem"], r["poisson"], r["candidate"]) == (problem, nu, name)]
    return own[2][key]  # the third mesh: the finest that all candidates have


def error_table(rows):
    lines = []
    for name in dict.fromkeys(r["candidate"] for r in rows):
        line = [label(name)]
        for problem in ("cook", "beam", "sphere"):
            for nu in ("0.3", "0.4999"):
                line.append(f"{100 * float(finest(rows, problem, nu, name, 'error')):.2f}")
        for problem in ("beam", "sphere"):
            line.append(f"{100 * float(finest(rows, problem, '0.4999', name, 'pressure_error')):.0f}")
        lines.append(bold(name, line))
    return table(["candidate", "Cook, nu 0.3", "Cook, 0.4999", "beam, 0.3", "beam, 0.4999",
                  "sphere, 0.3", "sphere, 0.4999", "pressure: beam, 0.4999",
                  "pressure: sphere, 0.4999"], lines)


def inf_sup_table(rows):
    lines = []
    for name in dict.fromkeys(r["candidate"] for r in rows):
        line = [label(name)]
        for mesh in ("cube", "irregular cube"):
            own = {r["cells"]: r for r in rows if r["candidate"] == name and r["mesh"] == mesh}
            line += [f"{float(own[c]['constant']):.4f} ({own[c]['spurious']} of {own[c]['groups']})"
                     if c in own else "" for c in ("4", "6", "8")]
        lines.append(bold(name, line))
    return table(["candidate"] + [f"{mesh}, {c}^3" for mesh in ("cut cells", "Delaunay")
                                  for c in (4, 6, 8)], lines)


def reference_table(rows):
    cases = list(dict.fromkeys(r["case"] for r in rows))
    return table(["case", "32 cells", "64", "128"],
                 [[c] + [f"{float(r['rise']):.4f}" for r in rows if r["case"] == c] for c in cases])


def main():
    results, docs = Path(sys.argv[1]), Path(sys.argv[2])
    images = docs / "images"
    rows = {name: read(results, name)
            for name in ("convergence", "layer", "face", "infsup", "cook_pressure", "reference")}
    convergence(rows["convergence"], lambda r: float(r["unknowns"]), "unknowns",
                images / "elements_unknowns.png")
    convergence(rows["convergence"], lambda r: 1e3 * (float(r["factor_s"]) + float(r["solve_s"])),
                "factor + solve (ms)", images / "elements_time.png")
    pressure(rows["cook_pressure"], images / "elements_pressure.png")
    layer(rows["layer"], rows["face"], images / "elements_layer.png")
    inf_sup(rows["infsup"], images / "elements_infsup.png")
    page = docs / "elements.md"
    if not page.exists():
        return
    text = page.read_text()
    tables = {"layer": layer_table(rows["layer"]), "face": face_table(rows["face"]),
              "errors": error_table(rows["convergence"]), "infsup": inf_sup_table(rows["infsup"]),
              "reference": reference_table(rows["reference"])}
    for name, content in tables.items():
        text = re.sub(rf"(<!-- table {name} -->\n).*?(<!-- end -->)",
                      lambda m: m.group(1) + content + "\n" + m.group(2), text, flags=re.S)
    page.write_text(text)


if __name__ == "__main__":
    main()
