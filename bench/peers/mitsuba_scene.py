"""The model of lxs_scene as a dictionary of Mitsuba 3."""

import os

import numpy as np


def write_ply(path, points, triangles, uv=None):
    """Binary PLY. points: (N, 3), uv: (N, 2) or None, triangles: (M, 3) numbers of points."""
    points = np.asarray(points, dtype="<f4")
    columns = [points] if uv is None else [points, np.asarray(uv, dtype="<f4")]
    names = ["x", "y", "z"] + ([] if uv is None else ["u", "v"])
    faces = np.empty(len(triangles), dtype=[("n", "u1"), ("v", "<i4", 3)])
    faces["n"], faces["v"] = 3, np.asarray(triangles)
    header = ["ply", "format binary_little_endian 1.0", f"element vertex {len(points)}"]
    header += [f"property float {name}" for name in names]
    header += [f"element face {len(faces)}", "property list uchar int vertex_indices", "end_header", ""]
    with open(path, "wb") as file:
        file.write("\n".join(header).encode())
        file.write(np.hstack(columns).tobytes())
        file.write(faces.tobytes())


def rgb(values):
    return {"type": "rgb", "value": [float(v) for v in values]}


def bsdf(material):
    """Reflecting materials are two-sided, as LuxRender's are."""
    if material.kind == "glass":
        return {"type": "dielectric", "int_ior": material.index, "ext_ior": 1.0}
    if material.kind == "matte":
        colour = rgb(material.colour)
        if material.texture:
            colour = {"type": "bitmap", "filename": material.texture, "raw": True, "filter_type": "bilinear",
                      "wrap_mode": "repeat"}
        inner = {"type": "diffuse", "reflectance": colour}
    elif material.kind == "mirror":
        inner = {"type": "conductor", "material": "none", "specular_reflectance": rgb(material.colour)}
    else:
        inner = {"type": "roughconductor", "material": "none", "distribution": "beckmann", "alpha": material.roughness,
                 "specular_reflectance": rgb(material.colour)}
    return {"type": "twosided", "bsdf": inner}


def mitsuba_dict(mi, scene, resolution, folder, sampler="independent", rr_depth=5):
    """A dictionary for mi.load_dict; meshes are written into folder. Those of one material become one mesh, which is what
    Mitsuba does best with. Its max_depth counts edges of a path, LuxRender's maxdepth the vertices between: one less."""
    made = {
        "type": "scene",
        "integrator": {"type": "path", "max_depth": scene.max_depth + 1, "rr_depth": rr_depth},
        "sensor": {
            "type": "perspective", "fov": scene.fov, "fov_axis": "smaller", "near_clip": 1e-3, "far_clip": 1e30,
            "to_world": mi.ScalarTransform4f().look_at(origin=scene.eye, target=scene.target, up=scene.up),
            "film": {"type": "hdrfilm", "width": resolution[0], "height": resolution[1], "pixel_format": "rgb",
                     "component_format": "float32", "rfilter": {"type": "box"}},
            "sampler": {"type": sampler},
        },
    }
    if scene.environment:
        made["environment"] = {"type": "constant", "radiance": rgb(scene.environment)}
    materials = {}
    merged = {}
    for i, shape in enumerate(scene.shapes):
        name = materials.setdefault(shape.material, f"material{len(materials)}")
        made.setdefault(name, bsdf(shape.material))
        entry = {"bsdf": {"type": "ref", "id": name}}
        if shape.emission:
            entry["emitter"] = {"type": "area", "radiance": rgb(shape.emission)}
        if shape.kind == "sphere":
            entry.update(type="sphere", center=list(shape.centre), radius=shape.radius)
        elif shape.kind == "ply":
            entry.update(type="ply", filename=shape.path, face_normals=True)
        else:
            key = (name, i if shape.emission else None)
            points, triangles, _ = merged.setdefault(key, ([], [], entry))
            triangles += [tuple(v + len(points) for v in t) for t in shape.triangles]
            points += shape.points
            continue
        made[f"shape{i}"] = entry
    for j, (points, triangles, entry) in enumerate(merged.values()):
        path = os.path.join(folder, f"{scene.name}-mesh{j}.ply")
        write_ply(path, points, triangles)
        made[f"mesh{j}"] = {"type": "ply", "filename": path, "face_normals": True, **entry}
    return made
