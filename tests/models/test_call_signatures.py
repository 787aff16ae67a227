"""Every solver takes the body, then the motion; wrong arguments are rejected with a remedy."""

import numpy as np
import pytest

from seisblock.bodies.block import Block
from seisblock.bodies.pile.toml import load_pile
from seisblock.bodies.spring_block import SpringBlock
from seisblock.bodies.two_layer import Contact, TwoLayerBlock
from seisblock.core.errors import ComponentError, KindError, ParameterError
from seisblock.models.jump.solve import solve_jump
from seisblock.models.rock.solve import solve_rock
from seisblock.models.slide.solve import solve_slide
from seisblock.models.stack.solve import solve_stack
from seisblock.models.uplift.solve import solve_uplift
from seisblock.records import Component, Motion, Record, motion_of

LAYERS = TwoLayerBlock(2.08, 2.50, 1.06, 1.84, 1303.7, 160.0)
SPRINGS = SpringBlock.from_frequency(0.6, 0.6, 1.8, frequency_vertical=10.0, beta=0.707)
BLOCK = Block(0.2, 0.6)
MOTION = Motion.from_arrays(2.5 * np.sin(np.linspace(0.0, 12.0, 200)), 0.01, vertical=np.cos(np.linspace(0.0, 9.0, 200)))
LEVEL = Record((Component("NS", MOTION.horizontal), Component("EW", 0.5 * MOTION.horizontal)), 0.01, source="level.csv")


def jump(block, motion):
    """Solve a jump with some contact."""
    return solve_jump(block, motion, contact=Contact(0.18, 0.17, 0.95, 0.85))


SOLVERS = [(solve_slide, 0.2), (solve_rock, BLOCK), (jump, LAYERS), (solve_uplift, SPRINGS), (solve_stack, load_pile("wagata"))]
calls = pytest.mark.parametrize(("solve", "body"), SOLVERS, ids=["slide", "rock", "jump", "uplift", "stack"])


@calls
def test_solvers_reject_record_as_motion_and_name_selector(solve, body):
    """A record holds several components: the message names the call that chooses one."""
    with pytest.raises(KindError, match=r"found a Record \(.*level.csv\): select a component with motion_of\(record, 'NS'\)"):
        solve(body, LEVEL)


@calls
def test_solvers_reject_array_as_motion_and_name_constructor(solve, body):
    """An array knows no time step: the message names what makes a motion of it."""
    with pytest.raises(TypeError, match=r"expected a Motion, found ndarray.*from_arrays"):
        solve(body, MOTION.horizontal)


@calls
def test_solvers_reject_motion_before_body(solve, body):
    """The wrong order is recognised."""
    with pytest.raises(ValueError, match="expected the body first, then the motion, found Motion before "):
        solve(MOTION, body)


def test_argument_order_error_names_both_arguments():
    """The message names the arguments in order."""
    with pytest.raises(KindError, match="expected the body first, then the motion, found Motion before Block"):
        solve_rock(MOTION, BLOCK)
    with pytest.raises(KindError, match="found Record before TwoLayerBlock"):
        jump(LEVEL, LAYERS)


@pytest.mark.parametrize(
    ("solve", "kind"), [(solve_rock, "Block"), (jump, "TwoLayerBlock"), (solve_uplift, "SpringBlock"), (solve_stack, "Pile")]
)
def test_solvers_reject_body_of_another_kind(solve, kind):
    """The message names the kind that the solver follows."""
    with pytest.raises(KindError, match=f"expected {kind}, found str"):
        solve("gravestone", MOTION)


@pytest.mark.parametrize(("solve", "body"), [SOLVERS[0], SOLVERS[1]], ids=["slide", "rock"])
def test_vertical_true_without_vertical_component_is_rejected(solve, body):
    """Asked for, it is refused; a motion made of arrays has one, of zeros."""
    with pytest.raises(ComponentError, match=r"level.csv: no vertical component \(components: NS, EW\)"):
        solve(body, motion_of(LEVEL, "NS"), vertical=True)
    assert solve(body, Motion.from_arrays(MOTION.horizontal, 0.01), vertical=True).outcome


@pytest.mark.parametrize(("solve", "body"), [SOLVERS[3], SOLVERS[4]], ids=["uplift", "stack"])
def test_solvers_in_space_accept_record_without_vertical_component(solve, body):
    """Solvers in space take a record without a vertical component for one that does not move up and down."""
    single = solve(body, motion_of(LEVEL, "NS"))
    np.testing.assert_array_equal(single.time, solve(body, motion_of(LEVEL, "NS"), vertical=False).time)


@pytest.mark.parametrize(("solve", "body"), [SOLVERS[i] for i in (0, 1, 3, 4)], ids=["slide", "rock", "uplift", "stack"])
def test_vertical_accepts_bool_or_factor(solve, body):
    """True acts like 1 and False like 0; half the vertical motion acts like a motion of half its height."""
    half = Motion.from_arrays(MOTION.horizontal, 0.01, vertical=0.5 * MOTION.vertical)
    for single, right, motion in ((True, 1.0, MOTION), (False, 0.0, MOTION), (0.5, True, half)):
        first, second = solve(body, MOTION, vertical=single), solve(body, motion, vertical=right)
        assert first.outcome == second.outcome
    assert solve(body, MOTION, vertical=True).outcome != solve(body, MOTION, vertical=False).outcome
    with pytest.raises(ParameterError, match="vertical gain must be a finite number"):
        solve(body, MOTION, vertical=float("nan"))
