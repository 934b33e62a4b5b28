"""What `agglomerate export` writes for ParaView, as one wants to see it: spheres by their radius, contacts as tubes by their tension.

Red: pulled, blue: pressed; of several frames the last one is shown, and ParaView's buttons play them with their times. It runs in
ParaView's own Python, and opens a window to draw in: where there is no screen, xvfb-run makes one.

    pvpython view.py granule.hdf.series --state granule.pvsm
    xvfb-run -a -s "-screen 0 1280x1024x24 -noreset" pvpython view.py granule.hdf --picture granule.png
"""

import argparse

try:
    from paraview import simple
except ModuleNotFoundError:  # --help is for every Python
    simple = None


def shown(name):
    """Pipeline and view; what it gives: reader, spheres, tubes."""
    reader = simple.OpenDataFile(name)
    if reader is None:
        raise SystemExit(f"{name}: ParaView has no reader for it; agglomerate export -o NAME.hdf writes one that it has")
    scene = simple.GetAnimationScene()
    scene.UpdateAnimationUsingDataTimeSteps()
    scene.GoToLast()
    view = simple.CreateRenderView()
    view.ViewSize = [1200, 900]
    view.UseColorPaletteForBackground = 0
    view.Background = [1, 1, 1]
    view.OrientationAxesVisibility = 0

    spheres = simple.Glyph(Input=reader, GlyphType="Sphere")
    spheres.GlyphType.Radius = 1
    spheres.GlyphType.ThetaResolution = spheres.GlyphType.PhiResolution = 24
    spheres.OrientationArray = ["POINTS", "No orientation array"]
    spheres.ScaleArray = ["POINTS", "radius"]
    spheres.ScaleFactor = 0.4  # of the radius: contacts stay in sight
    spheres.GlyphMode = "All Points"
    ball = simple.Show(spheres, view)
    ball.ColorArrayName = ["POINTS", ""]  # one colour
    ball.DiffuseColor = ball.AmbientColor = [0.7, 0.7, 0.7]

    contacts = simple.Threshold(Input=reader, Scalars=["CELLS", "contact"], LowerThreshold=1, UpperThreshold=1)
    lines = simple.ExtractSurface(Input=contacts)
    tubes = simple.Tube(Input=lines)
    tubes.UpdatePipeline(scene.TimeKeeper.Time)
    radius = reader.PointData["radius"].GetRange()
    tubes.Radius = 0.15 * sum(radius) / 2
    rod = simple.Show(tubes, view)
    simple.ColorBy(rod, ("CELLS", "normal_force"))
    reach = max(abs(end) for end in tubes.CellData["normal_force"].GetRange()) or 1e-12
    colours = simple.GetColorTransferFunction("normal_force")
    colours.ApplyPreset("Cool to Warm", True)
    colours.RescaleTransferFunction(-reach, reach)
    bar = simple.GetScalarBar(colours, view)
    bar.Title, bar.ComponentTitle = "tension, N", ""
    bar.TitleColor = bar.LabelColor = [0, 0, 0]
    rod.SetScalarBarVisibility(view, True)
    view.CameraParallelProjection = 1
    simple.ResetCamera(view)
    return reader, spheres, tubes, view


def command_line():
    first, _, rest = __doc__.strip().partition("\n")
    parser = argparse.ArgumentParser(description=first, epilog=rest.strip("\n"), formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file", help="FILE.hdf or FILE.hdf.series of agglomerate export")
    parser.add_argument("--state", metavar="FILE.pvsm", help="for paraview --state=FILE.pvsm")
    parser.add_argument("--picture", metavar="FILE.png", help="what is seen first")
    return parser


def main(options):
    if simple is None:
        raise SystemExit("this Python has no paraview: pvpython pipeline/view.py ...")
    if not (options.state or options.picture):
        raise SystemExit("say --state FILE.pvsm or --picture FILE.png")
    _, _, _, view = shown(options.file)
    if options.state:
        simple.SaveState(options.state)
    if options.picture:
        simple.SaveScreenshot(options.picture, view)


if __name__ == "__main__":
    main(command_line().parse_args())
