"""A package with one triangle in every kind of mesh that the page draws, written by hand."""

import base64
import json
import struct
import zlib

CORNERS = ((0.0, 0.0, 0.0), (0.3, 0.0, 0.0), (0.0, 0.3, 0.0))

OBJ = "v 0 0 0\nv 0.3 0 0\nv 0 0.3 0\nf 1 2 3\n"

DAE = """<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset><unit name="meter" meter="1"/><up_axis>Z_UP</up_axis></asset>
  <library_images><image id="i"><init_from>../textures/red.png</init_from></image></library_images>
  <library_effects><effect id="e"><profile_COMMON>
    <newparam sid="s"><surface type="2D"><init_from>i</init_from></surface></newparam>
    <newparam sid="t"><sampler2D><source>s</source></sampler2D></newparam>
    <technique sid="c"><lambert><diffuse><texture texture="t" texcoord="UV"/></diffuse></lambert>
    </technique></profile_COMMON></effect></library_effects>
  <library_materials><material id="m"><instance_effect url="#e"/></material></library_materials>
  <library_geometries><geometry id="g"><mesh>
    <source id="p"><float_array id="pa" count="9">0 0 0 0.3 0 0 0 0.3 0</float_array>
      <technique_common><accessor source="#pa" count="3" stride="3"><param name="X" type="float"/>
      <param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common>
    </source>
    <source id="u"><float_array id="ua" count="6">0 0 1 0 0 1</float_array>
      <technique_common><accessor source="#ua" count="3" stride="2"><param name="S" type="float"/>
      <param name="T" type="float"/></accessor></technique_common></source>
    <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
    <triangles count="1" material="mm"><input semantic="VERTEX" source="#v" offset="0"/>
      <input semantic="TEXCOORD" source="#u" offset="1" set="0"/><p>0 0 1 1 2 2</p></triangles>
  </mesh></geometry></library_geometries>
  <library_visual_scenes><visual_scene id="w"><node id="n"><instance_geometry url="#g">
    <bind_material><technique_common><instance_material symbol="mm" target="#m"/>
    </technique_common></bind_material></instance_geometry></node></visual_scene>
  </library_visual_scenes>
  <scene><instance_visual_scene url="#w"/></scene>
</COLLADA>
"""


def stl() -> bytes:
    numbers = [0.0, 0.0, 1.0, *(one for corner in CORNERS for one in corner)]
    return b"\0" * 80 + struct.pack("<I", 1) + struct.pack("<12fH", *numbers, 0)


def gltf() -> str:
    raw = struct.pack("<9f", *(one for corner in CORNERS for one in corner))
    buffer = f"data:application/octet-stream;base64,{base64.b64encode(raw).decode()}"
    return json.dumps(
        {
            "asset": {"version": "2.0"},
            "scene": 0,
            "scenes": [{"nodes": [0]}],
            "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
            "buffers": [{"uri": buffer, "byteLength": len(raw)}],
            "bufferViews": [{"buffer": 0, "byteLength": len(raw)}],
            "accessors": [
                {
                    "bufferView": 0,
                    "componentType": 5126,
                    "count": 3,
                    "type": "VEC3",
                    "min": [0, 0, 0],
                    "max": [0.3, 0.3, 0],
                }
            ],
        }
    )


def png() -> bytes:
    """Return a PNG picture of one red pixel."""

    def chunk(kind: bytes, content: bytes) -> bytes:
        check = zlib.crc32(kind + content)
        return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", check)

    head = struct.pack(">IIBBBBB", 1, 1, 8, 2, 0, 0, 0)
    pixels = zlib.compress(b"\0\xff\0\0")
    return (
        b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", pixels) + chunk(b"IEND", b"")
    )


def write_package(folder, name="arm_description"):
    """Write the package; return its folder."""
    package = folder / name
    for part in ("meshes", "textures", "urdf"):
        (package / part).mkdir(parents=True)
    (package / "package.xml").write_text(f"<package><name>{name}</name></package>")
    (package / "meshes" / "a.stl").write_bytes(stl())
    (package / "meshes" / "a.obj").write_text(OBJ)
    (package / "meshes" / "a.dae").write_text(DAE)
    (package / "meshes" / "a.gltf").write_text(gltf())
    (package / "meshes" / "broken.stl").write_bytes(b"solid?")
    (package / "textures" / "red.png").write_bytes(png())
    return package
