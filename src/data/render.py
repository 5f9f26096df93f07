"""Picture of a state of spheres, drawn without a screen by VTK.

    render.py FOLDER PICTURE.png COLOUR WIDTH TITLE

FOLDER has grains.vtp, contacts.vtp, cell.vtp and walls.vtp. On the left the grains with their radii, coloured by COLOUR
("speed": of the fluctuation; "coordination": contacts of the grain), those of rough walls grey; on the right the contact
forces as tubes: radius and colour grow with the normal force up to four times its mean. Walls are clear surfaces.
Exit codes: 0 done; 3 there is no VTK for this Python; 4 VTK has nothing to draw with; 1 anything else.
"""
import ctypes
import os
import sys

try:
    import vtk
    from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy
    import numpy
except ImportError as error:
    print(error, file=sys.stderr)
    sys.exit(3)

FONT = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf"  # VTK's own fonts have no Greek letters
PARTS = ("grains", "contacts", "cell", "walls")
SATURATION = 4.0  # tubes grow up to this many mean forces
RADIUS_AT_MEAN = 0.055  # of a tube, in mean diameters


def current_context():
    """A current OpenGL context without window and without X server (EGL on Mesa's surfaceless platform), or None.

    Debian's VTK is built for X only; its generic window draws in whatever context is current.
    """
    surfaceless, opengl_api, no_attributes = 0x31DD, 0x30A2, 0x3038
    surface_type, pbuffer, renderable_type, opengl = 0x3033, 0x0001, 0x3040, 0x0008
    try:
        egl = ctypes.CDLL("libEGL.so.1")
    except OSError:
        return None
    pointer = ctypes.c_void_p
    egl.eglGetProcAddress.restype = pointer
    egl.eglGetProcAddress.argtypes = [ctypes.c_char_p]
    for name, result, arguments in [
        ("eglInitialize", ctypes.c_uint, [pointer] * 3),
        ("eglBindAPI", ctypes.c_uint, [ctypes.c_uint]),
        ("eglChooseConfig", ctypes.c_uint, [pointer, pointer, pointer, ctypes.c_int, pointer]),
        ("eglCreateContext", pointer, [pointer] * 4),
        ("eglMakeCurrent", ctypes.c_uint, [pointer] * 4),
    ]:
        function = getattr(egl, name)
        function.restype, function.argtypes = result, arguments
    address = egl.eglGetProcAddress(b"eglGetPlatformDisplayEXT")
    if not address:
        return None
    display = ctypes.CFUNCTYPE(pointer, ctypes.c_uint, pointer, pointer)(address)(surfaceless, None, None)
    if not display or not egl.eglInitialize(display, None, None) or not egl.eglBindAPI(opengl_api):
        return None
    wanted = (ctypes.c_int * 5)(surface_type, pbuffer, renderable_type, opengl, no_attributes)
    config, count = pointer(), ctypes.c_int()
    if not egl.eglChooseConfig(display, wanted, ctypes.byref(config), 1, ctypes.byref(count)) or count.value == 0:
        return None
    version = (ctypes.c_int * 5)(0x3098, 3, 0x30FB, 2, no_attributes)
    context = egl.eglCreateContext(display, config, None, version)
    if not context or not egl.eglMakeCurrent(display, None, None, context):
        return None
    return lambda *ignored: egl.eglMakeCurrent(display, None, None, context)


def make_window():
    make_current = current_context()
    if make_current is None:
        return None
    # GLEW, built for X, says that it knows no display; it has found its functions all the same.
    vtk.vtkObject.GlobalWarningDisplayOff()
    window = vtk.vtkGenericOpenGLRenderWindow()
    window.AddObserver("WindowMakeCurrentEvent", make_current)
    window.AddObserver("WindowIsCurrentEvent", lambda caller, event: caller.SetIsCurrent(True))
    window.SetReadyForRendering(True)
    window.SetSupportsOpenGL(1)
    window.SetIsCurrent(True)
    window.SetOffScreenRendering(1)
    return window if window.InitializeFromCurrentContext() else None


def read(path):
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


def set_font(text):
    if os.path.isfile(FONT):
        text.SetFontFamily(vtk.VTK_FONT_FILE)
        text.SetFontFile(FONT)
    else:
        text.SetFontFamilyToArial()


def colours(stops, low, high):
    table = vtk.vtkColorTransferFunction()
    table.SetColorSpaceToLab()
    for k, stop in enumerate(stops):
        place = low + (high - low) * k / (len(stops) - 1)
        table.AddRGBPoint(place, *[int(stop[a : a + 2], 16) / 255 for a in (1, 3, 5)])
    return table


def colour_bar(table, width):
    bar = vtk.vtkScalarBarActor()
    bar.SetLookupTable(table)
    bar.SetTitle("")  # a caption of its own: VTK sets a title too close to the numbers
    bar.SetNumberOfLabels(5)
    bar.SetLabelFormat("%-#.3g")
    bar.SetOrientationToHorizontal()
    bar.SetPosition(0.2, 0.045)
    bar.SetWidth(0.6)
    bar.SetHeight(0.06)
    bar.SetTextPositionToPrecedeScalarBar()
    bar.UnconstrainedFontSizeOn()
    text = bar.GetLabelTextProperty()
    text.SetColor(0.1, 0.1, 0.1)
    text.SetFontSize(17 * width // 1600)
    set_font(text)
    text.ItalicOff()
    text.BoldOff()
    text.ShadowOff()
    return bar


def caption(text, x, y, size):
    actor = vtk.vtkTextActor()
    actor.SetInput(text)
    actor.GetPositionCoordinate().SetCoordinateSystemToNormalizedViewport()
    actor.SetPosition(x, y)
    actor.GetTextProperty().SetFontSize(size)
    set_font(actor.GetTextProperty())
    actor.GetTextProperty().SetColor(0.1, 0.1, 0.1)
    return actor


def below_bar(text, width):
    actor = caption(text, 0.5, 0.012, 20 * width // 1600)
    actor.GetTextProperty().SetJustificationToCentered()
    return actor


def grains_actor(grains, chosen, values, table, opacity):
    """The grains of the mask `chosen`; None without any. `values` colours them; None: grey."""
    if not chosen.any():
        return None
    shown = vtk.vtkPolyData()
    points = vtk.vtkPoints()
    points.SetData(numpy_to_vtk(vtk_to_numpy(grains.GetPoints().GetData())[chosen], deep=1))
    shown.SetPoints(points)
    columns = {"diameter": 2 * vtk_to_numpy(grains.GetPointData().GetArray("radius"))}
    if values is not None:
        columns["value"] = values.astype(float)
    for name, numbers in columns.items():
        column = numpy_to_vtk(numbers[chosen], deep=1)
        column.SetName(name)
        shown.GetPointData().AddArray(column)
    sphere = vtk.vtkSphereSource()
    sphere.SetRadius(0.5)
    detail = 24 if grains.GetNumberOfPoints() <= 5000 else 12
    sphere.SetThetaResolution(detail)
    sphere.SetPhiResolution(detail)
    mapper = vtk.vtkGlyph3DMapper()
    mapper.SetInputData(shown)
    mapper.SetSourceConnection(sphere.GetOutputPort())
    mapper.SetScaleArray("diameter")
    mapper.SetScaleModeToScaleByMagnitude()
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    if values is None:
        mapper.ScalarVisibilityOff()
        actor.GetProperty().SetColor(0.55, 0.6, 0.66)
    else:
        mapper.SetScalarModeToUsePointFieldData()
        mapper.SelectColorArray("value")
        mapper.SetLookupTable(table)
    actor.GetProperty().SetOpacity(opacity)
    actor.GetProperty().SetSpecular(0.25)
    actor.GetProperty().SetSpecularPower(30)
    return actor


def wall_actors(walls):
    """Clear surfaces, with the lines where they end."""
    if walls.GetNumberOfPolys() == 0:
        return []
    merged = vtk.vtkCleanPolyData()  # sides of a cylinder share their corners
    merged.SetInputData(walls)
    surface = vtk.vtkPolyDataMapper()
    surface.SetInputConnection(merged.GetOutputPort())
    surface.ScalarVisibilityOff()
    clear = vtk.vtkActor()
    clear.SetMapper(surface)
    clear.GetProperty().SetColor(0.36, 0.5, 0.65)
    clear.GetProperty().SetOpacity(0.13)
    clear.GetProperty().LightingOff()
    ends = vtk.vtkFeatureEdges()
    ends.SetInputConnection(merged.GetOutputPort())
    ends.ManifoldEdgesOff()
    ends.NonManifoldEdgesOff()
    ends.ColoringOff()
    lines = vtk.vtkPolyDataMapper()
    lines.SetInputConnection(ends.GetOutputPort())
    edges = vtk.vtkActor()
    edges.SetMapper(lines)
    edges.GetProperty().SetColor(0.24, 0.36, 0.5)
    edges.GetProperty().SetLineWidth(1.5)
    return [clear, edges]


def tubes_actor(contacts, diameter, table):
    """Tubes along the branches; None without forces."""
    force = numpy.abs(vtk_to_numpy(contacts.GetCellData().GetArray("normal_force"))) if contacts.GetNumberOfLines() else []
    if len(force) == 0 or not numpy.mean(force) > 0:
        return None
    relative = numpy.minimum(force / numpy.mean(force), SATURATION)
    shown = vtk.vtkPolyData()
    shown.SetPoints(contacts.GetPoints())
    shown.SetLines(contacts.GetLines())
    for name, values in [
        ("relative", numpy.repeat(relative, 2)),
        ("radius", numpy.maximum(numpy.repeat(relative, 2), 0.08) * RADIUS_AT_MEAN * diameter),
    ]:
        column = numpy_to_vtk(values.astype(float), deep=1)
        column.SetName(name)
        shown.GetPointData().AddArray(column)
    shown.GetPointData().SetActiveScalars("radius")
    tube = vtk.vtkTubeFilter()
    tube.SetInputData(shown)
    tube.SetVaryRadiusToVaryRadiusByAbsoluteScalar()
    tube.SetNumberOfSides(10)
    tube.CappingOn()
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputConnection(tube.GetOutputPort())
    mapper.SetScalarModeToUsePointFieldData()
    mapper.SelectColorArray("relative")
    mapper.SetLookupTable(table)
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    return actor


def edges_actor(cell):
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputData(cell)
    mapper.ScalarVisibilityOff()
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(0.1, 0.1, 0.1)
    actor.GetProperty().SetLineWidth(2)
    return actor


def show(renderer, *actors):
    for actor in actors:
        if actor is not None:
            renderer.AddActor(actor)


def look(renderer):
    """From the front, a little from the right and from above, with z upwards."""
    camera = renderer.GetActiveCamera()
    camera.SetPosition(0.55, -1.0, 0.45)
    camera.SetFocalPoint(0, 0, 0)
    camera.SetViewUp(0, 0, 1)
    camera.SetViewAngle(22)
    renderer.ResetCamera()
    camera.Zoom(1.0)
    centre = camera.GetFocalPoint()
    span = camera.GetDistance() * 0.025
    camera.SetFocalPoint(centre[0], centre[1], centre[2] - span)  # room for the bar below, the title above
    renderer.ResetCameraClippingRange()


def main(folder, picture, colour, width, title):
    window = make_window()
    if window is None:
        print("no OpenGL context: EGL with a software renderer is missing (libegl1, libgl1-mesa-dri)", file=sys.stderr)
        return 4
    grains, contacts, cell, walls = [read(os.path.join(folder, part + ".vtp")) for part in PARTS]
    data = grains.GetPointData()
    glued = vtk_to_numpy(data.GetArray("boundary")) != 0
    diameter = 2 * float(numpy.mean(vtk_to_numpy(data.GetArray("radius"))))
    if colour == "coordination":
        values, label = vtk_to_numpy(data.GetArray("contacts")).astype(float), "contacts of the grain"
        low, high = 0.0, max(1.0, float(values.max()))
    else:
        values = numpy.linalg.norm(vtk_to_numpy(data.GetArray("fluctuation")), axis=1)
        label, low = "speed of the fluctuation", 0.0
        moving = values[~glued] if not glued.all() else values
        high = float(numpy.percentile(moving, 98)) or 1.0  # a few fast grains must not hide the others
    grain_colours = colours(["#4a5a9e", "#2f7f9d", "#22a884", "#7ad151", "#fde725"], low, high)
    force_colours = colours(["#ec973e", "#d65424", "#a0182a", "#4a0422"], 0.0, SATURATION)

    left, right = vtk.vtkRenderer(), vtk.vtkRenderer()
    left.SetViewport(0, 0, 0.5, 1)
    right.SetViewport(0.5, 0, 1, 1)
    show(left, grains_actor(grains, ~glued, values, grain_colours, 1.0), grains_actor(grains, glued, None, None, 0.35))
    left.AddActor2D(colour_bar(grain_colours, width))
    left.AddActor2D(below_bar(label, width))
    tubes = tubes_actor(contacts, diameter, force_colours)
    show(right, grains_actor(grains, ~glued, None, None, 0.1), grains_actor(grains, glued, None, None, 0.2))
    if tubes is not None:
        right.AddActor(tubes)
        right.AddActor2D(colour_bar(force_colours, width))
        right.AddActor2D(below_bar("normal force / its mean", width))
    else:
        right.AddActor2D(caption("no contact forces", 0.38, 0.06, 22 * width // 1600))
    left.AddActor2D(caption(title, 0.03, 0.95, 23 * width // 1600))
    right.AddActor2D(caption("contact forces", 0.03, 0.95, 20 * width // 1600))
    for renderer in (left, right):
        renderer.SetBackground(1, 1, 1)
        show(renderer, edges_actor(cell), *wall_actors(walls))
        window.AddRenderer(renderer)
    window.SetMultiSamples(8)
    window.SetSize(width, width * 9 // 16)
    look(left)
    right.SetActiveCamera(left.GetActiveCamera())
    window.Render()
    shot = vtk.vtkWindowToImageFilter()
    shot.SetInput(window)
    shot.ReadFrontBufferOff()
    shot.Update()
    writer = vtk.vtkPNGWriter()
    writer.SetFileName(picture)
    writer.SetInputConnection(shot.GetOutputPort())
    writer.Write()
    return 0 if writer.GetErrorCode() == 0 else 1


if __name__ == "__main__":
    code = main(*sys.argv[1:4], int(sys.argv[4]), sys.argv[5])
    sys.stderr.flush()
    # Without VTK's own clean-up, which looks for the X server that is not there.
    os._exit(code)
