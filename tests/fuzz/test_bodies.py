"""Damaged descriptions of bodies and cemeteries are read, or rejected in one sentence."""

from __future__ import annotations

import time

import numpy as np
import pytest

from seisblock.bodies.block import Block
from seisblock.bodies.cemetery.table import read_cemetery
from seisblock.bodies.factory import load_block, table_friction, table_restitution
from seisblock.bodies.pile.toml import load_pile
from seisblock.bodies.toml import read_body_toml
from seisblock.bodies.two_layer import load_contact, load_two_layer
from seisblock.core.errors import InputError
from seisblock.samples import sample_path
from seisblock.studies.report.models import body_models
from tests.fuzz.accidents import spoil
from tests.fuzz.values import as_toml, with_mistakes

pytestmark = pytest.mark.slow

VALUES = 150
SLOWEST_S = 10.0
LONGEST_MESSAGE = 1500

SURVEY = (
    "# 墓地\n竿高さ（cm）,竿幅（cm）,補強,転倒,方位,個数\n62.4,24,無,転倒,90,1\n６３,24,有,残存,,2\n50,25,,,,\n"
    + "".join(f"{60 + i},2{i % 8},無,{'転倒' if i % 3 else '残存'},{i * 10},{i % 5 + 1}\n" for i in range(20))
).encode("cp932")
BODIES = ("gravestone", "chozusha", "wagata", "lantern")


def load(path):
    """Look at a file of a body as every command does."""
    table = read_body_toml(path)
    items = [body_models(str(path), frequency_vertical=10.0)] if table.get("kind") != "pile" else []
    table_restitution(table, str(path))
    table_friction(table, str(path))
    if table.get("kind") == "two-layer":
        items += [load_two_layer(path, side="long"), load_contact(path)]
    if table.get("kind") == "pile":
        items += [load_pile(path, reinforced=bool(table.get("reinforced"))), load_pile(path, mu=0.5)]
    return [*items, load_block(path)]


def refused_or(use, path, seed):
    """Return what a file is used for, or None when it is refused in one sentence that names it, in good time."""
    start = time.process_time()
    try:
        return use(path)
    except InputError as error:
        assert "\n" not in str(error) and len(str(error)) < LONGEST_MESSAGE, seed
        return None
    finally:
        assert time.process_time() - start < SLOWEST_S, seed


@pytest.mark.parametrize("name", BODIES)
def test_random_body_values_give_body_or_one_error(name, seeds, tmp_path):
    """Lists, dates, truths, texts and extreme numbers wherever a number, a text or a table belongs; entries lost and invented."""
    table = read_body_toml(sample_path(f"{name}.toml"))
    path = tmp_path / "body.toml"
    read = 0
    for seed in seeds(VALUES):
        path.write_text(as_toml(with_mistakes(table, np.random.default_rng(seed))), encoding="utf-8")
        created = refused_or(load, path, seed)
        if created:
            read += 1
            block = created[-1]
            sizes = (block.radius, block.total_mass, block.slenderness, *block.restitutions, *block.corner_inertias)
            assert isinstance(block, Block) and np.isfinite(sizes).all() and block.radius > 0.0, seed
    assert 0 < read < len(seeds(VALUES))


@pytest.mark.parametrize("name", BODIES)
def test_damaged_body_file_gives_body_or_one_error(name, seeds, tmp_path):
    """Bytes lost, cut, repeated and changed."""
    full = sample_path(f"{name}.toml").read_bytes()
    path = tmp_path / "body.toml"
    for seed in seeds(VALUES):
        path.write_bytes(spoil(full, np.random.default_rng((seed, 1))))
        refused_or(load, path, seed)


@pytest.mark.parametrize("name", ["aoyama", "survey"])
def test_damaged_cemetery_gives_cemetery_or_one_error(name, seeds, tmp_path):
    """Every stone that is read has proportions and stands for some stones."""
    full = SURVEY if name == "survey" else sample_path("aoyama.csv").read_bytes()
    path = tmp_path / "cemetery.csv"
    read = 0
    for seed in seeds(2 * VALUES):
        path.write_bytes(spoil(full, np.random.default_rng((seed, 2))))
        result = refused_or(read_cemetery, path, seed)
        if result:
            read += 1
            assert result.size == sum(stone.count for stone in result.stones) > 0, seed
            assert np.isfinite(result.ratios).all() and (result.ratios > 0.0).all(), seed
    assert 0 < read < len(seeds(2 * VALUES))
