// THE page of signs, symbols and units. Every other header refers to this one.
//
// Units. Any consistent system: a scene is either dimensional or reduced (d = m = P = 1); the code never
// assumes one. In 2D a pressure is a force per length.
//
// Grains.   R radius, d = 2R diameter, m mass, I moment of inertia (disk m R^2 / 2, sphere 2 m R^2 / 5),
//           x position, w angular velocity.
// Cell.     cell.box: columns are the cell vectors. L = cell.rate: velocity gradient, d(box)/dt = L box.
//           The velocity of a grain is v + L x; the column called `velocity` holds v, the fluctuation.
// Contact   (i, j), i < j: n unit vector from i to j; b branch vector from i to the image of j that it meets;
//           gap g = |b| - R_i - R_j, negative in overlap; deflection h = max(0, -g).
//           Lever arms l_i = R_i |b| / (R_i + R_j) and l_j likewise, so that l_i + l_j = |b| and angular momentum
//           is conserved to rounding. A plane is a body of its own, at rest or moved; l_j = 0.
// Relative  u = v_j - v_i + L b - (l_i w_i + l_j w_j) x n: velocity of j's contact point seen from i's.
// velocity  u_N = n.u > 0 when the contact opens; u_T = u - u_N n.
// Force     F acts on j, -F on i; F_N = n.F > 0 repulsive. Impulse (reaction) r likewise, r = F dt.
// Torque    on i and on j: -l_i n x F and -l_j n x F (the same sign: contact points lie on opposite sides).
// Stress    sigma = (1/V) (sum over contacts of F (x) b + sum over grains of m v (x) v): positive in compression.
//           Shear stress: sigma_xy < 0 when L_xy > 0; mu* = |sigma_xy| / sigma_yy.
//
// Two symbols never meet: h is a deflection and dt the time step; H is the contact Jacobian and box the cell.
#pragma once
