"""Contact states, states and parameters of the uplift model."""

from __future__ import annotations

ALL_CORNERS, GLUED = 15, 31
"""All four corners in contact; linear system without uplift."""

U, F, TURN_X, TURN_Y, X, Y, W, VX, VY, CHANGES, FIRST = 0, 4, 8, 9, 10, 11, 12, 16, 17, 18, 19
"""First of four corner displacements, first of four forces, b theta_x, b theta_y, x, y, first of four rates, rates of x and y, counts."""

N_STATES, TRACKED = 20, 10

ALPHA, GAMMA, KX, KY, KZ, CX, CY, CZ, JX, JY, GRAVITY, SUBSTEPS, STEP, PROPAGATORS = range(14)
"""Ratios H/b and a/b; 4 kx/m, 4 ky/m, kz/m, 1/s^2; the dashpots likewise, 1/s; moments of inertia over m b^2; gravity, m/s^2; number and
length, s, of the steps of the propagators per sample; first entry of the propagators of the 16 contact states."""
