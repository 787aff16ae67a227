"""Speed of animations: a film of a 20 s response is drawn faster than it plays."""

import numpy as np

from seisblock.bodies.block import Block
from seisblock.models.rock.animate import animate
from seisblock.models.rock.solve import solve_rock
from seisblock.output.animation.render import AnimationOptions
from seisblock.records import Motion


def test_animation_of_20_s_rocking(benchmark, tmp_path):
    """A 20 s response as a .gif, in real time; where benchmarks are disabled two seconds of it show that it works."""
    t = np.arange(201 if benchmark.disabled else 2001) * 0.01
    response = solve_rock(Block(0.3, 0.9), Motion.from_arrays(3.4 * np.sin(2 * np.pi * 1.7 * t), 0.01, name="NS"))
    benchmark.pedantic(animate, args=(response, tmp_path / "rock.gif", AnimationOptions()), rounds=1)
    assert (tmp_path / "rock.gif").read_bytes().startswith(b"GIF89a")
