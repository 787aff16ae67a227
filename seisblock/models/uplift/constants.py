"""Contact states, states and parameters of the uplift model."""

from __future__ import annotations

ALL_CORNERS, GLUED = 15, 31
"""All four corners in contact; linear system without uplift."""

U, F, TURN_X, TURN_Y, X, Y, Z, VA, VB, VX, VY, VZ, CHANGES, FIRST = 0, 4, *range(8, 20)
"""First of four corner displacements, first of four forces, b theta_x, b theta_y, x, y, z above static equilibrium, the rates of the last
five, counts."""

N_STATES, TRACKED = 20, 10

HALF_ALPHA, HALF_GAMMA, KX, KY, KZ, CX, CY, CZ, JX, JY, PER_JX, PER_JY = range(12)
"""Half the ratios H/b and a/b; 4 kx/m, 4 ky/m, kz/m, 1/s^2; the dashpots likewise, 1/s; moments of inertia over m b^2; one over these."""

PER_ROOT_JX, PER_ROOT_JY, GRAVITY, SETTLEMENT, LEVER = range(12, 17)
"""One over the roots of the moments of inertia; gravity, m/s^2; static settlement, m; largest displacement of a corner per unit of the
coordinates times the roots of their masses."""

SUBSTEPS, STEP, DEGREE, FOURTH, PROPAGATORS = range(17, 22)
"""Number and length, s, of the steps of the propagators per sample; degree of the power series; largest ratio of fourth to third
derivatives, 1/s; first entry of the propagators of the 16 contact states."""
