# SPDX-License-Identifier: Apache-2.0
"""One small scene for each effect of the path tracer: three balls on a floor below a lamp."""
import math

from gltf_writer import Scene, as_float, bumps, checkers, quad, radiance_hdr, sphere

MATTE = {"specular": {"specularFactor": 0.0}}
GLASS = {"transmission": {"transmissionFactor": 1.0}, "ior": {"ior": 1.5}}


def stage(lamp=True, **arguments):
    scene = Scene(((0.0, 1.6, 4.6), (0.0, 0.55, 0.0), 0.6), **arguments)
    scene.square, scene.ball = scene.geometry(*quad()), scene.geometry(*sphere(24, 12))
    scene.material("floor", (0.5, 0.5, 0.5), **MATTE)
    scene.place(scene.square, "floor", scale=[12.0, 1.0, 12.0])
    if lamp:
        scene.material("lamp", (0.0, 0.0, 0.0), emission=(12.0, 11.0, 10.0))
        scene.place(scene.square, "lamp", scale=[1.5, 1.0, 1.5], rotation=[1.0, 0.0, 0.0, 0.0],
                    translation=[0.0, 3.5, 0.5])
    return scene


def balls(scene, names):
    """A ball of each of these materials, in a row."""
    for k, name in enumerate(names):
        scene.place(scene.ball, name, scale=[0.5] * 3,
                    translation=[as_float(1.15 * (k - (len(names) - 1) / 2)), 0.5, 0.0])
    return scene


def of_materials(*materials, **arguments):
    """A scene of balls whose materials are given as (colour, metallic, roughness, members)."""
    scene = stage(**arguments)
    for k, (color, metallic, roughness, members) in enumerate(materials):
        scene.material(f"ball {k}", color, metallic, roughness, **members)
    return balls(scene, [f"ball {k}" for k in range(len(materials))])


def textures(normal):
    scene = stage()
    if normal:
        info = {"normalTexture": scene.texture(bumps(16, 2))}
    else:
        info = {"baseColorTexture": scene.texture(checkers(16, 4, (180, 40, 30), (230, 220, 200)))}
    scene.material("ball", (0.9, 0.9, 0.9), 0.0, 0.4, textures=info)
    return balls(scene, ["ball", "ball"])


def punctual_lights():
    scene = of_materials(((0.7, 0.2, 0.1), 0.0, 1.0, MATTE), lamp=False)
    scene.point_light([-1.0, 2.5, 1.5], [1.0, 0.8, 0.6], 12.0)
    scene.point_light([1.5, 1.5, 1.0], [0.4, 0.6, 1.0], 6.0)
    return scene


def sky(width, height):
    """A blue gradient above brown ground, with a sun."""
    rows = []
    for y in range(height):
        up = 1.0 - 2.0 * (y + 0.5) / height
        row = [[0.25 + 0.2 * up, 0.4 + 0.3 * up, 0.9] if up > 0 else [0.2, 0.15, 0.1] for _ in range(width)]
        if y == height // 4:
            row[width // 3] = [150.0, 130.0, 100.0]
        rows.append(row)
    return radiance_hdr(rows)


def volume(color, distance):
    return {"volume": {"thicknessFactor": 1.0, "attenuationColor": color, "attenuationDistance": distance}}


def film(thickness):
    return {"iridescence": {"iridescenceFactor": 1.0, "iridescenceIor": 1.4,
                            "iridescenceThicknessMaximum": thickness}}


def brushed(rotation):
    return {"anisotropy": {"anisotropyStrength": 0.9, "anisotropyRotation": as_float(rotation)}}


def depth_of_field():
    scene = stage(lens={"aperture_radius": 0.12, "focus_distance": 4.6})
    scene.material("ball", (0.2, 0.4, 0.7), **MATTE)
    for k in range(4):
        scene.place(scene.ball, "ball", scale=[0.4] * 3, translation=[-1.2 + 0.8 * k, 0.4, 1.5 - 1.5 * k])
    return scene


def motion_blur():
    scene = stage(lens={"shutter_open": 0.0, "shutter_close": 0.5})
    scene.material("ball", (0.2, 0.6, 0.3), **MATTE)
    scene.place(scene.ball, "ball", scale=[0.5] * 3, translation=[1.0, 0.5, 0.0])
    moving = scene.place(scene.ball, "ball", scale=[0.5] * 3, translation=[-1.2, 0.5, 0.0])
    scene.animate(moving, "translation", [0.0, 1.0], [[-1.2, 0.5, 0.0], [0.4, 0.9, 0.0]])
    return scene


def effect_scenes():
    """The files of all of them, as bytes."""
    stone = {"shader": "marble", "second_color": [0.1, 0.12, 0.2], "pattern_scale": 2.0}
    tree = {"shader": "wood", "second_color": [0.25, 0.12, 0.05], "pattern_scale": 5.0}
    fog = {"medium_scattering": [0.12, 0.12, 0.12], "medium_absorption": [0.02, 0.01, 0.0],
           "medium_anisotropy": 0.4}
    white = (1.0, 1.0, 1.0)
    scenes = {
        "emitters": of_materials(((0.1, 0.1, 0.1), 0.0, 1.0, {"emission": (4.0, 1.0, 0.3)})),
        "matte": of_materials(((0.7, 0.3, 0.2), 0.0, 1.0, MATTE), ((0.2, 0.3, 0.7), 0.0, 1.0, MATTE)),
        "metal": of_materials(((1.0, 0.77, 0.34), 1.0, 0.1, {}), ((0.95, 0.64, 0.54), 1.0, 0.5, {})),
        "plastic": of_materials(((0.7, 0.1, 0.1), 0.0, 0.2, {}), ((0.1, 0.5, 0.2), 0.3, 0.5, {})),
        "marble": of_materials(((0.85, 0.83, 0.8), 0.0, 1.0, {"extras": stone})),
        "wood": of_materials(((0.65, 0.4, 0.18), 0.0, 0.4, {"extras": tree})),
        "smooth-glass": of_materials((white, 0.0, 0.0, GLASS)),
        "rough-glass": of_materials((white, 0.0, 0.3, GLASS)),
        "clearcoat": of_materials(((0.5, 0.02, 0.1), 0.5, 0.5, {"clearcoat": {"clearcoatFactor": 1.0}})),
        "sheen": of_materials(((0.2, 0.03, 0.24), 0.0, 0.9, {
            "sheen": {"sheenColorFactor": [0.85, 0.65, 0.9], "sheenRoughnessFactor": 0.35}})),
        "iridescence": of_materials(((0.02, 0.02, 0.02), 0.0, 0.15, film(350.0)),
                                    ((0.6, 0.6, 0.6), 1.0, 0.2, film(250.0))),
        "anisotropy": of_materials(((0.9, 0.9, 0.9), 1.0, 0.25, brushed(0.0)),
                                   ((0.9, 0.9, 0.9), 1.0, 0.25, brushed(math.pi / 2))),
        "medium": of_materials(((0.7, 0.7, 0.7), 0.0, 1.0, MATTE), **fog),
        "textures": textures(normal=False),
        "normal-maps": textures(normal=True),
        "punctual-lights": punctual_lights(),
        "environment": of_materials(((0.9, 0.9, 0.9), 1.0, 0.1, {}), ((0.7, 0.7, 0.7), 0.0, 1.0, MATTE),
                                    lamp=False, environment="sky.hdr", environment_intensity=0.8),
        "absorption": of_materials((white, 0.0, 0.0, {**GLASS, **volume([0.2, 0.8, 0.5], 0.6)}),
                                   (white, 0.0, 0.0, {**GLASS, **volume([0.9, 0.4, 0.1], 0.6)})),
        "dispersion": of_materials((white, 0.0, 0.0, {**GLASS, "dispersion": {"dispersion": 2.0}})),
        "motion-blur": motion_blur(),
        "depth-of-field": depth_of_field(),
    }
    files = {f"{name}.gltf": scene.text().encode() for name, scene in scenes.items()}
    files["sky.hdr"] = sky(32, 16)
    return files
