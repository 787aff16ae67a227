"""A file of a body may hold anything: a list, a date, a truth, a text or 1e308 where a number belongs is one sentence (FINDINGS R12)."""

from __future__ import annotations

import os
import time

import pytest

from seisblock.bodies.factory import load_block, table_friction, table_restitution
from seisblock.bodies.pile.toml import load_pile
from seisblock.bodies.toml import read_body_toml
from seisblock.bodies.two_layer import load_contact, load_two_layer
from seisblock.core.errors import BodyError, InputError
from seisblock.samples import sample_path

NO_NUMBERS = ("true", "[1]", "{ a = 1 }", "2020-01-01", "07:32:00", '"x"', "nan", "inf", "9" * 400, "1e308", "-1")
NO_SIZES = (*NO_NUMBERS, "1e-320")
STONE = 'kind = "pile"\n[[stone]]\nname = "a"\nwidth = 1\ndepth = 1\nheight = 1\n'


def write_body(tmp_path, text):
    """Return a file."""
    path = tmp_path / "body.toml"
    path.write_text(text, encoding="utf-8")
    return path


@pytest.mark.parametrize("value", NO_SIZES)
@pytest.mark.parametrize("key", ["width", "height", "depth", "mass", "centroid_height", "centroid_inertia", "density"])
def test_block_file_rejects_invalid_values(key, value, tmp_path):
    """Its sizes, mass and inertia: ``width = true`` was 1 m."""
    entries = {"width": "0.3", "height": "1.0", key: value}
    path = write_body(tmp_path, 'kind = "block"\n' + "".join(f"{name} = {text}\n" for name, text in entries.items()))
    with pytest.raises(InputError, match=key.split("_")[-1].replace("height", "(height|centre)")):
        load_block(path)


@pytest.mark.parametrize("value", NO_NUMBERS[:9])
@pytest.mark.parametrize("key", ["mu", "mu_kinetic"])
def test_contact_values_reject_invalid_types(key, value, tmp_path):
    """Contact values beside the block reject invalid types."""
    table = read_body_toml(write_body(tmp_path, f'kind = "block"\nwidth = 0.3\nheight = 1\n{key} = {value}\nrestitution = {value}\n'))
    with pytest.raises(BodyError, match=key):
        table_friction(table, "body.toml")
    with pytest.raises(BodyError, match="restitution"):
        table_restitution(table, "body.toml")


@pytest.mark.parametrize("value", NO_NUMBERS)
@pytest.mark.parametrize("key", ["width", "density", "mu", "offset", "bottom", "on", "name"])
def test_pile_stone_rejects_invalid_values(key, value, tmp_path):
    """Every entry of a stone, and one that is no table at all."""
    entries = {"name": '"a"', "width": "1", "depth": "1", "height": "1", key: value}
    if (key, value) in {("on", '"x"'), ("name", '"x"')}:
        value = entries[key] = "3"
    path = write_body(tmp_path, 'kind = "pile"\n[[stone]]\n' + "".join(f"{name} = {text}\n" for name, text in entries.items()))
    with pytest.raises(InputError):
        load_pile(path)
    with pytest.raises(BodyError, match=r"at least one|unknown entries a"):
        load_pile(write_body(tmp_path, f'kind = "pile"\nstone = [{value}]\n'))


@pytest.mark.parametrize(
    "line", ["reinforced = 3", "reinforced = [[1]]", 'reinforced = ["ab"]', "fixed = true", "fixed = [[1]]", "name = 3"]
)
def test_name_lists_reject_plain_text(line, tmp_path):
    """A text is no list of its letters."""
    with pytest.raises(BodyError, match=f"{line.split()[0]} must be a"):
        load_pile(write_body(tmp_path, STONE.replace("[[stone]]", f"{line}\n[[stone]]")))


@pytest.mark.parametrize("value", [*NO_NUMBERS[:9], "{ mu = 'x' }", "{ mu = [1] }", "{ mu = true }"])
def test_two_layer_contact_rejects_invalid_values(value, tmp_path):
    """A table of numbers."""
    full = sample_path("chozusha.toml").read_text(encoding="utf-8").split("[contact]")[0]
    path = write_body(tmp_path, f"{full}\ncontact = {value}\n")
    assert load_two_layer(path).width == 2.08
    with pytest.raises(BodyError, match="contact"):
        load_contact(path)


def test_source_is_always_file_name(tmp_path):
    """``source`` is the name of the file, whatever its content."""
    path = write_body(tmp_path, 'kind = "block"\nsource = "another"\nwidth = 0.3\n')
    with pytest.raises(BodyError, match=r"body\.toml: height is missing"):
        load_block(path)


@pytest.mark.parametrize("text", ["a = " + "[" * 5000, "a = 2020-13-45"], ids=["nested", "date"])
def test_invalid_toml_is_rejected(text, tmp_path):
    """Lists in lists in lists, a date that is none."""
    path = tmp_path / "body.toml"
    path.write_bytes(text.encode("utf-8", "surrogateescape"))
    with pytest.raises(BodyError, match="is not valid TOML"):
        read_body_toml(path)


def test_impossible_file_names_are_rejected():
    """Too long for a file system, or with a NUL: no such body, in a sentence of ordinary length."""
    for name in ("x" * 5000, "a\0b"):
        with pytest.raises(BodyError, match="no body file") as caught:
            read_body_toml(name)
        assert len(str(caught.value)) < 1000


@pytest.mark.skipif(os.geteuid() == 0, reason="root reads everything")
def test_unreadable_file_states_system_reason(tmp_path):
    """The reason of the system."""
    path = write_body(tmp_path, STONE)
    path.chmod(0)
    with pytest.raises(BodyError, match="Permission denied"):
        read_body_toml(path)


def test_pile_with_too_many_stones_is_rejected(tmp_path):
    """The number of pairs of stones is limited; the error names the limit."""
    stone = "[[stone]]\nname = '{i}'\nwidth = 1\ndepth = 1\nheight = 1\n"
    path = write_body(tmp_path, "kind = 'pile'\n" + "".join(stone.format(i=i) for i in range(5000)))
    start = time.process_time()
    with pytest.raises(BodyError, match="5000 stones of a pile exceed the limit of 200"):
        load_pile(path)
    assert time.process_time() - start < 5.0


@pytest.mark.parametrize(
    ("content", "reason"),
    [
        (b"", "is empty: give a TOML file"),
        (b"\n  \n", "is empty: give a TOML file"),
        ('kind = "pile"\nname = "墓石"\n'.encode("shift_jis"), "is not UTF-8 text: .* saved as UTF-8"),
        (bytes(range(128, 256)), "is not UTF-8 text"),
    ],
)
def test_empty_or_foreign_encoded_file_is_rejected(tmp_path, content, reason):
    """An empty file and a wrong encoding give messages without terms of the decoder."""
    path = tmp_path / "body.toml"
    path.write_bytes(content)
    with pytest.raises(BodyError, match=reason) as error:
        load_pile(path)
    assert "codec" not in str(error.value)
