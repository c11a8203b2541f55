"""Writes the textured scene: a displaced sphere of 102 thousand triangles and a floor, both with images, a mirror ball, a
lamp and a sky of one colour. textured_mesh.py FOLDER"""

import os
import struct
import sys
import zlib

import numpy as np

from mitsuba_scene import write_ply


def write_png(path, pixels):
    """8-bit RGB; pixels: (H, W, 3) of 0..255, top row first."""
    height, width, _ = pixels.shape
    rows = np.concatenate([np.zeros((height, 1), np.uint8), pixels.astype(np.uint8).reshape(height, -1)], axis=1)

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
                   + chunk(b"IDAT", zlib.compress(rows.tobytes())) + chunk(b"IEND", b""))


def picture(size):
    """Stripes, rings and checks: no axis of it is symmetric, so that a turned or mirrored image shows."""
    y, x = np.mgrid[0:size, 0:size] / size
    checks = ((np.floor(8 * x) + np.floor(8 * y)) % 2)
    red = .15 + .65 * checks * (1 - .5 * y)
    green = .2 + .5 * (.5 + .5 * np.sin(2 * np.pi * (3 * x + 2 * y)))
    blue = .1 + .7 * (.5 + .5 * np.cos(40 * np.hypot(x - .3, y - .6)))
    return np.round(255 * np.clip(np.stack([red, green, blue], axis=2), 0, 1))


def displaced_sphere(columns, rows):
    """Points, uv and triangles of a sphere about (0, 1.1, 0) whose radius waves between .8 and 1."""
    v, u = np.mgrid[0:rows + 1, 0:columns + 1]
    u, v = u / columns, v / rows
    phi, theta = 2 * np.pi * u, np.pi * v
    direction = np.stack([np.sin(theta) * np.cos(phi), np.cos(theta), np.sin(theta) * np.sin(phi)], axis=2)
    radius = .9 + np.sin(theta) * (.06 * np.sin(7 * phi) * np.sin(9 * theta) + .04 * np.sin(31 * phi + 5 * theta))
    points = direction * radius[:, :, None] + [0, 1.1, 0]
    at = np.arange((rows + 1) * (columns + 1)).reshape(rows + 1, columns + 1)
    a, b, c, d = at[:-1, :-1], at[:-1, 1:], at[1:, 1:], at[1:, :-1]
    triangles = np.concatenate([np.stack([a, b, c], 2).reshape(-1, 3), np.stack([a, c, d], 2).reshape(-1, 3)])
    # The outer of the two triangles at a pole has no area.
    corners = points.reshape(-1, 3)[triangles]
    area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    return points.reshape(-1, 3), np.stack([u, v], 2).reshape(-1, 2), triangles[area > 1e-9]


SCENE = """# A displaced sphere and a floor, both with images, a mirror ball, a lamp and a sky of one colour.
LookAt 0 2.2 -5.5   0.2 0.85 0   0 1 0
Camera "perspective" "float fov" [36]
Film "fleximage" "integer xresolution" [384] "integer yresolution" [288]
SurfaceIntegrator "path" "integer maxdepth" [8]
WorldBegin
LightSource "infinite" "color L" [.25 .3 .4]
Texture "stripes" "color" "imagemap" "string filename" ["stripes.png"] "float gamma" [1]
  "string filtertype" ["bilinear"] "string wrap" ["repeat"]
AttributeBegin
  Material "matte" "color Kd" [0 0 0]
  AreaLightSource "area" "color L" [12 11 9] "float gain" [1] "float power" [0] "float efficacy" [0]
  Shape "mesh" "integer triindices" [0 1 2 0 2 3] "point P" [-2.5 4 -1.5  -1 4 -1.5  -1 4 0  -2.5 4 0]
AttributeEnd
Material "matte" "texture Kd" ["stripes"]
Shape "plymesh" "string filename" ["displaced.ply"]
Shape "plymesh" "string filename" ["floor.ply"]
AttributeBegin
  Translate 1.6 .6 -.6
  Material "mirror" "color Kr" [.9 .9 .9]
  Shape "sphere" "float radius" [.6]
AttributeEnd
WorldEnd
"""


def write_scene(folder):
    """Returns the path of the .lxs file in folder."""
    os.makedirs(folder, exist_ok=True)
    write_png(os.path.join(folder, "stripes.png"), picture(512))
    points, uv, triangles = displaced_sphere(320, 160)
    # Corners of its own for every triangle: LuxRender smooths PLY meshes without normals, but not across these.
    write_ply(os.path.join(folder, "displaced.ply"), points[triangles].reshape(-1, 3),
              np.arange(triangles.size).reshape(-1, 3), uv[triangles].reshape(-1, 2))
    write_ply(os.path.join(folder, "floor.ply"), [(-6, 0, -6), (-6, 0, 6), (6, 0, 6), (6, 0, -6)],
              [(0, 1, 2), (0, 2, 3)], [(-1.5, -1.5), (-1.5, 1.5), (1.5, 1.5), (1.5, -1.5)])
    path = os.path.join(folder, "textured-mesh.lxs")
    with open(path, "w", encoding="utf-8") as file:
        file.write(SCENE)
    return path


if __name__ == "__main__":
    print(write_scene(sys.argv[1]))
