"""A small part of the LuxRender scene format, read into a model that two renderers can be given alike.

Read are: LookAt, a perspective camera, film size, the depth of the path integrator, meshes (triangles, quads, PLY files)
and spheres, placed by Translate at most, the materials matte, mirror, glass and metal2, area lights of plain
radiance, constant environments, image textures of matte. Whatever else a scene holds is an error: what is left out
would make the pictures differ.
"""

import os
import re
from dataclasses import dataclass, field

TOKEN = re.compile(r'"([^"]*)"|([\[\]])|([^\s"\[\]#]+)|#[^\n]*')


@dataclass(frozen=True)
class Material:
    """kind: matte, mirror, glass or metal. colour: reflectance, linear, one per channel. texture: path of an image of
    plain (not gamma-coded) reflectances instead of it. index: of refraction. roughness: root mean square slope
    of Beckmann's distribution."""
    kind: str
    colour: tuple = (1.0, 1.0, 1.0)
    texture: str = ""
    index: float = 1.5
    roughness: float = 0.0


@dataclass
class Shape:
    """kind: mesh (points, triangles), ply (path) or sphere (centre, radius). emission: radiance on the side of the
    normal (right-hand rule; outside of a sphere), or None."""
    kind: str
    material: Material
    emission: tuple = None
    points: list = field(default_factory=list)
    triangles: list = field(default_factory=list)
    path: str = ""
    centre: tuple = (0.0, 0.0, 0.0)
    radius: float = 1.0


@dataclass
class Scene:
    """max_depth counts as LuxRender does: 1 is direct light. fov: degrees across the shorter side."""
    name: str
    eye: tuple = (0, 0, 0)
    target: tuple = (0, 0, 1)
    up: tuple = (0, 1, 0)
    fov: float = 90.0
    width: int = 800
    height: int = 600
    max_depth: int = 16
    environment: tuple = None
    shapes: list = field(default_factory=list)


class SceneError(Exception):
    pass


def tokens(text):
    for match in TOKEN.finditer(text):
        string, bracket, word = match.groups()
        if string is not None:
            yield ("string", string)
        elif bracket:
            yield (bracket, bracket)
        elif word:
            yield ("word", word)


def statements(text):
    """Yields (name, arguments, parameters): arguments are the numbers and strings before the first "type name"
    parameter; parameters a dict from name to a list."""
    items = list(tokens(text))
    i = 0
    while i < len(items):
        kind, name = items[i]
        if kind != "word" or not name[0].isalpha():
            raise SceneError(f"a statement was expected, not {name}")
        i += 1
        arguments, parameters = [], {}
        while i < len(items):
            kind, value = items[i]
            if kind == "word" and value[0].isalpha():
                break
            i += 1
            if kind == "string" and " " in value.strip():
                values = []
                if items[i][0] == "[":
                    i += 1
                    while items[i][0] != "]":
                        values.append(items[i][1])
                        i += 1
                else:
                    values.append(items[i][1])
                i += 1
                declared, key = value.split()
                convert = {"integer": int, "string": str, "texture": str, "bool": str}.get(declared, float)
                parameters[key] = [convert(v) for v in values]
            elif kind == "string":
                arguments.append(value)
            elif kind == "word":
                arguments.append(float(value))
        yield name, arguments, parameters


class Reader:
    """Goes through the statements with the state that they change."""

    def __init__(self, path):
        self.folder = os.path.dirname(os.path.abspath(path))
        self.scene = Scene(os.path.splitext(os.path.basename(path))[0])
        self.material = Material("matte")
        self.emission = None
        self.offset = (0.0, 0.0, 0.0)
        self.named = {}
        self.images = {}
        self.fresnels = {}
        self.saved = []

    def read(self, text):
        for name, arguments, parameters in statements(text):
            handler = getattr(self, "on_" + name, None)
            if handler is None:
                raise SceneError(f"{name}: not among what is converted")
            rest = handler(arguments, dict(parameters))
            if rest:
                raise SceneError(f"{name} {arguments[:1]}: parameters that are not converted: {', '.join(rest)}")
        return self.scene

    def on_LookAt(self, a, p):
        self.scene.eye, self.scene.target, self.scene.up = tuple(a[0:3]), tuple(a[3:6]), tuple(a[6:9])
        return p

    def on_Camera(self, a, p):
        if a[0] != "perspective":
            raise SceneError(f"Camera {a[0]}")
        self.scene.fov = p.pop("fov", [90.0])[0]
        return p

    def on_Film(self, a, p):
        # Tone mapping and file names do not change radiance.
        self.scene.width = p.get("xresolution", [800])[0]
        self.scene.height = p.get("yresolution", [600])[0]
        if "cropwindow" in p:
            raise SceneError("Film: cropwindow")

    def on_PixelFilter(self, a, p):
        pass  # both are given the box

    def on_Sampler(self, a, p):
        pass  # the protocol says which

    def on_SurfaceIntegrator(self, a, p):
        if a[0] != "path":
            raise SceneError(f"SurfaceIntegrator {a[0]}")
        self.scene.max_depth = p.pop("maxdepth", [16])[0]
        return p

    def on_WorldBegin(self, a, p):
        return p

    on_WorldEnd = on_WorldBegin

    def on_AttributeBegin(self, a, p):
        self.saved.append((self.material, self.emission, self.offset))

    def on_AttributeEnd(self, a, p):
        self.material, self.emission, self.offset = self.saved.pop()

    def on_Translate(self, a, p):
        self.offset = tuple(o + d for o, d in zip(self.offset, a))

    def on_Texture(self, a, p):
        name, _, kind = a
        if kind == "fresnelcolor":
            self.fresnels[name] = tuple(p.pop("Kr"))
        elif kind == "imagemap":
            if p.pop("filtertype", [""])[0] != "bilinear" or p.pop("gamma", [1.0])[0] != 1.0:
                raise SceneError(f"Texture {name}: only bilinear images of gamma 1")
            self.images[name] = os.path.join(self.folder, p.pop("filename")[0])
            p.pop("wrap", None) == ["repeat"] or p.update(wrap=[])
        else:
            raise SceneError(f"Texture {name}: {kind}")
        return p

    def make_material(self, kind, p):
        if kind == "matte":
            kd = p.pop("Kd", [1.0, 1.0, 1.0])
            made = Material("matte", texture=self.images[kd[0]]) if isinstance(kd[0], str) else Material("matte", tuple(kd))
        elif kind == "mirror":
            made = Material("mirror", tuple(p.pop("Kr", [1.0, 1.0, 1.0])))
        elif kind == "glass":
            made = Material("glass", index=p.pop("index", [1.5])[0])
        elif kind == "metal2":
            roughness = p.pop("uroughness", [0.1])
            if p.pop("vroughness", [0.1]) != roughness:
                raise SceneError("metal2 with two roughnesses")
            made = Material("metal", self.fresnels[p.pop("fresnel")[0]], roughness=roughness[0])
        else:
            raise SceneError(f"Material {kind}")
        return made

    def on_Material(self, a, p):
        self.material = self.make_material(a[0], p)
        return p

    def on_MakeNamedMaterial(self, a, p):
        self.named[a[0]] = self.make_material(p.pop("type")[0], p)
        return p

    def on_NamedMaterial(self, a, p):
        self.material = self.named[a[0]]

    def on_AreaLightSource(self, a, p):
        if p.pop("power", [100.0]) != [0.0] or p.pop("efficacy", [17.0]) != [0.0]:
            raise SceneError("AreaLightSource: only with power 0 and efficacy 0, so that L is the radiance")
        gain = p.pop("gain", [1.0])[0]
        self.emission = tuple(gain * c for c in p.pop("L", [1.0, 1.0, 1.0]))
        return p

    def on_LightSource(self, a, p):
        if a[0] != "infinite":
            raise SceneError(f"LightSource {a[0]}")
        gain = p.pop("gain", [1.0])[0]
        self.scene.environment = tuple(gain * c for c in p.pop("L", [1.0, 1.0, 1.0]))
        return p

    def on_Shape(self, a, p):
        shape = Shape({"mesh": "mesh", "trianglemesh": "mesh", "plymesh": "ply"}.get(a[0], a[0]), self.material, self.emission)
        if shape.kind == "mesh":
            flat = p.pop("P")
            shape.points = [tuple(c + o for c, o in zip(flat[i:i + 3], self.offset)) for i in range(0, len(flat), 3)]
            index = p.pop("triindices", p.pop("indices", []))
            shape.triangles = [tuple(index[i:i + 3]) for i in range(0, len(index), 3)]
            quads = p.pop("quadindices", [])
            for i in range(0, len(quads), 4):
                q = quads[i:i + 4]
                shape.triangles += [(q[0], q[1], q[2]), (q[0], q[2], q[3])]
        elif shape.kind == "ply":
            if self.offset != (0.0, 0.0, 0.0):
                raise SceneError("plymesh under a transform")
            shape.path = os.path.join(self.folder, p.pop("filename")[0])
        elif shape.kind == "sphere":
            shape.centre, shape.radius = self.offset, p.pop("radius", [1.0])[0]
        else:
            raise SceneError(f"Shape {a[0]}")
        self.scene.shapes.append(shape)
        return p


def read_lxs(path):
    """The scene of a file. Raises SceneError for what is not converted."""
    with open(path, encoding="utf-8") as file:
        return Reader(path).read(file.read())


def numbers(values):
    return "[" + " ".join(f"{v:.9g}" for v in values) + "]"


def material_lines(material, i):
    if material.kind == "matte" and material.texture:
        return [f'Texture "image{i}" "color" "imagemap" "string filename" ["{material.texture}"] "float gamma" [1]',
                '  "string filtertype" ["bilinear"] "string wrap" ["repeat"]',
                f'Material "matte" "texture Kd" ["image{i}"]']
    if material.kind == "matte":
        return [f'Material "matte" "color Kd" {numbers(material.colour)}']
    if material.kind == "mirror":
        return [f'Material "mirror" "color Kr" {numbers(material.colour)}']
    if material.kind == "glass":
        return [f'Material "glass" "float index" [{material.index:.9g}]']
    return [f'Texture "fresnel{i}" "fresnel" "fresnelcolor" "color Kr" {numbers(material.colour)}',
            f'Material "metal2" "texture fresnel" ["fresnel{i}"] "float uroughness" [{material.roughness:.9g}]'
            f' "float vroughness" [{material.roughness:.9g}]']


def write_lxs(scene, path, resolution):
    """Writes the model with the box filter, so that pixels are independent, and the material before every shape: the
    file means the same by LuxRender's and YART's rules, but for metal2."""
    lines = [f"# {scene.name}, as converted for comparison with other renderers",
             f"LookAt {' '.join(f'{v:.9g}' for v in (*scene.eye, *scene.target, *scene.up))}",
             f'Camera "perspective" "float fov" [{scene.fov:.9g}]',
             f'Film "fleximage" "integer xresolution" [{resolution[0]}] "integer yresolution" [{resolution[1]}]',
             'PixelFilter "box" "float xwidth" [0.5] "float ywidth" [0.5]',
             f'SurfaceIntegrator "path" "integer maxdepth" [{scene.max_depth}]',
             "WorldBegin"]
    if scene.environment:
        lines.append(f'LightSource "infinite" "color L" {numbers(scene.environment)}')
    for i, shape in enumerate(scene.shapes):
        lines.append("AttributeBegin")
        if shape.kind == "sphere":
            lines.append("Translate " + " ".join(f"{v:.9g}" for v in shape.centre))
        lines += material_lines(shape.material, i)
        if shape.emission:
            lines.append(f'AreaLightSource "area" "color L" {numbers(shape.emission)} "float gain" [1] "float power" [0]'
                         ' "float efficacy" [0]')
        if shape.kind == "sphere":
            lines.append(f'Shape "sphere" "float radius" [{shape.radius:.9g}]')
        elif shape.kind == "ply":
            lines.append(f'Shape "plymesh" "string filename" ["{shape.path}"]')
        else:
            lines.append(f'Shape "mesh" "integer triindices" {numbers([v for t in shape.triangles for v in t])}')
            lines.append(f'  "point P" {numbers([v for point in shape.points for v in point])}')
        lines.append("AttributeEnd")
    lines.append("WorldEnd")
    with open(path, "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")
