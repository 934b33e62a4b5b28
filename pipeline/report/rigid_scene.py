"""The scene with which rigidstress loads the same granule in the same fluid as a breakup did.

Radius, material, bonds, hydrodynamics and flow are those of its file.

    rigid_scene.py results/hollow-1-break.h5 -o results/hollow-1-break-rigid.toml
"""
import json
import sys

import arguments
import crumble

TAKEN = {"particle": ("radius", "fragments", "largest_gap"), "material": None, "fluid": ("viscosity",),
         "contact": ("rolling_stiffness_factor",), "hydrodynamics": None}
FLOWS = ("elongation", "shear", "uniaxial", "biaxial")


def rigid(of):
    """Text of the scene; `of` is that of the breakup, resolved."""
    if of["particle"].get("contacts") == "keep":
        sys.exit("particle.contacts = \"keep\": rigidstress closes the contacts and would load another granule")
    if "history" in of["flow"]:
        sys.exit(f"flow.history = \"{of['flow']['history']}\": name the history in a scene of rigidstress: its place is as seen from there")
    if of["flow"]["kind"] not in FLOWS:
        sys.exit(f"flow.kind = \"{of['flow']['kind']}\": nothing is loaded in it")
    lines = []
    for section, keys in TAKEN.items():
        lines.append(f"[{section}]")
        lines += [f"{key} = {json.dumps(value)}" for key, value in of[section].items() if keys is None or key in keys]
    lines += ["[flow]"] + [f"{flow} = {json.dumps(flow == of['flow']['kind'])}" for flow in FLOWS]
    return "\n".join(lines) + "\n"


def command_line():
    parser = arguments.parser(__doc__, "the scene (default: printed)", "FILE.toml", required=False)
    parser.add_argument("breakup", type=arguments.file, metavar="BREAKUP.h5", help="of breaker")
    return parser


def main(options):
    text = rigid(crumble.read(options.breakup).scene)
    with arguments.printing_to(options.out):
        print(text, end="")


if __name__ == "__main__":
    main(command_line().parse_args())
