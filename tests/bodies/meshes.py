"""Surfaces of triangles whose insides have closed forms, and files of them."""

import struct

import numpy as np


def frustum(sides, below, above, height, *, sheared=(0.0, 0.0)):
    """Return vertices and faces of a frustum over a regular polygon, with radii below and above; a radius of 0 makes a cone."""
    turn = 2.0 * np.pi * np.arange(sides) / sides
    ring = np.column_stack([np.cos(turn), np.sin(turn), np.zeros(sides)])
    low = ring * below
    high = ring * above + np.array([*sheared, height])
    vertices = np.concatenate([low, high, [[0.0, 0.0, 0.0], [*sheared, height]]])
    first, second = np.arange(sides), (np.arange(sides) + 1) % sides
    faces = [
        *np.column_stack([second, first, np.full(sides, 2 * sides)]),
        *np.column_stack([first + sides, second + sides, np.full(sides, 2 * sides + 1)]),
        *np.column_stack([first, second, second + sides]),
        *np.column_stack([first, second + sides, first + sides]),
    ]
    return vertices, np.array(faces)


def box(width, depth, height):
    """Return vertices and faces of a box whose base has its middle at the origin."""
    vertices, faces = frustum(4, 1.0, 1.0, height)
    rotated = vertices[:, :2] @ np.array([[1.0, 1.0], [-1.0, 1.0]])  # by an eighth: corners at (+-1, +-1)
    return np.column_stack([rotated * (0.5 * width, 0.5 * depth), vertices[:, 2]]), faces


def write_stl(path, vertices, faces):
    """Write a binary STL: triangles that share no vertex, single precision; return its path."""
    head = b"synthetic".ljust(80) + struct.pack("<I", len(faces))
    rows = np.zeros(len(faces), dtype=[("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("more", "<u2")])
    rows["corners"] = vertices[faces]
    path.write_bytes(head + rows.tobytes())
    return path


def write_obj(path, vertices, faces):
    """Write an OBJ with all digits; return its path."""
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in vertices.tolist()] + [
        "f " + " ".join(str(i + 1) for i in face) for face in faces.tolist()
    ]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


def write_ply(path, vertices, faces):
    """Write an ASCII PLY with all digits; return its path."""
    head = [
        "ply", "format ascii 1.0", f"element vertex {len(vertices)}", *(f"property double {axis}" for axis in "xyz"),
        f"element face {len(faces)}", "property list uchar int vertex_indices", "end_header",
    ]  # fmt: skip
    rows = [f"{x!r} {y!r} {z!r}" for x, y, z in vertices.tolist()] + ["3 " + " ".join(map(str, face)) for face in faces.tolist()]
    path.write_text("\n".join([*head, *rows]) + "\n", encoding="utf-8")
    return path
