# kinds.awk: the shape of each face of a geometry (in the plane of each curve), and bodies that touch: read after pick.awk
# Needs: pick.awk's outline, whose nodes lie on the geometry; its middles do so in a mesh of second order.
# Gives: shape(f): kind_[f] is plane, cylinder, cone, sphere or other, in the plane line, circle or other; spotOf[f, 1 2 3]: the middle
#        of a plane, a centre, or the place on the axis beside the face's middle; wayOf[f, 1 2 3]: normal or axis;
#        radius[f], of a cone there, tilt[f], its half angle; areaOf[f]. outward(f): the normal of a plane is turned out of the first body; hollow[f]: 1 of a bore. Least squares on the nodes: a kind
#        is told where all nodes are within 1e-6 of the face's size.  touch(): the pairs of bodies with faces of one place.
#        tell(): the table of -check 1, and the pairs with the statements that say what they are.
# n linear equations M v = r, into v[1 ...]; 0: singular
function solve_(M, r, n, v,   i, j, k, p, t) {
  for (i = 1; i <= n; i++) {
    p = i
    for (j = i + 1; j <= n; j++) if (M[j, i] ^ 2 > M[p, i] ^ 2) p = j
    if (M[p, i] ^ 2 < 1e-24) return 0
    for (k = 1; k <= n; k++) { t = M[i, k]; M[i, k] = M[p, k]; M[p, k] = t }
    t = r[i]; r[i] = r[p]; r[p] = t
    for (j = i + 1; j <= n; j++) {
      t = M[j, i] / M[i, i]
      for (k = i; k <= n; k++) M[j, k] -= t * M[i, k]
      r[j] -= t * r[i]
    }
  }
  for (i = n; i >= 1; i--) {
    t = r[i]
    for (k = i + 1; k <= n; k++) t -= M[i, k] * v[k]
    v[i] = t / M[i, i]
  }
  return 1
}
# least squares: row[1 ... n] v = value, one row more; fitted(v, n): v
function clear(n,   i, k) { for (i = 1; i <= n; i++) { rhs[i] = 0; for (k = 1; k <= n; k++) gram[i, k] = 0 } }
function addRow(n, value,   i, k) { for (i = 1; i <= n; i++) { rhs[i] += entry[i] * value; for (k = 1; k <= n; k++) gram[i, k] += entry[i] * entry[k] } }
# the direction in which vectors of these second moments S[1 ... 6] (xx yy zz xy yz zx) are least, by Jacobi's turns: least[1 2 3]
function leastWay(S,   A, V, i, j, k, turn, t, c, s, p, q, best) {
  A[1, 1] = S[1]; A[2, 2] = S[2]; A[3, 3] = S[3]; A[1, 2] = A[2, 1] = S[4]; A[2, 3] = A[3, 2] = S[5]; A[1, 3] = A[3, 1] = S[6]
  for (i = 1; i <= 3; i++) for (j = 1; j <= 3; j++) V[i, j] = i == j
  for (turn = 0; turn < 30; turn++) {
    i = 1 + (turn % 3 == 2); j = 2 + (turn % 3 > 0)
    if (A[i, j] ^ 2 < 1e-40) continue
    t = atan2(2 * A[i, j], A[j, j] - A[i, i]) / 2
    c = cos(t); s = sin(t)
    for (k = 1; k <= 3; k++) { p = A[k, i]; q = A[k, j]; A[k, i] = c * p - s * q; A[k, j] = s * p + c * q }
    for (k = 1; k <= 3; k++) { p = A[i, k]; q = A[j, k]; A[i, k] = c * p - s * q; A[j, k] = s * p + c * q }
    for (k = 1; k <= 3; k++) { p = V[k, i]; q = V[k, j]; V[k, i] = c * p - s * q; V[k, j] = s * p + c * q }
  }
  best = 1
  for (k = 2; k <= 3; k++) if (A[k, k] < A[best, best]) best = k
  for (k = 1; k <= 3; k++) least[k] = V[k, best]
}
# the normal of a quadratic piece at the place with weights l0, l1, l2 of its corners, as long as twice its area: crossed[1 2 3]
function crossAt(e, l0, l1, l2,   k, a, b, c, d, u, v) {
  if (straight[e]) { l0 = l1 = l2 = 1 / 3 }
  a = 4 * l0 - 1; b = 4 * l1 - 1; c = 4 * l2 - 1
  u[1] = b * X[e, 1] - a * X[e, 0] + 4 * ((l0 - l1) * X[e, 3] + l2 * (X[e, 4] - X[e, 5])); v[1] = c * X[e, 2] - a * X[e, 0] + 4 * ((l0 - l2) * X[e, 5] + l1 * (X[e, 4] - X[e, 3]))
  u[2] = b * Y[e, 1] - a * Y[e, 0] + 4 * ((l0 - l1) * Y[e, 3] + l2 * (Y[e, 4] - Y[e, 5])); v[2] = c * Y[e, 2] - a * Y[e, 0] + 4 * ((l0 - l2) * Y[e, 5] + l1 * (Y[e, 4] - Y[e, 3]))
  u[3] = b * Z[e, 1] - a * Z[e, 0] + 4 * ((l0 - l1) * Z[e, 3] + l2 * (Z[e, 4] - Z[e, 5])); v[3] = c * Z[e, 2] - a * Z[e, 0] + 4 * ((l0 - l2) * Z[e, 5] + l1 * (Z[e, 4] - Z[e, 3]))
  crossed[1] = u[2] * v[3] - u[3] * v[2]; crossed[2] = u[3] * v[1] - u[1] * v[3]; crossed[3] = u[1] * v[2] - u[2] * v[1]
  return sqrt(crossed[1] ^ 2 + crossed[2] ^ 2 + crossed[3] ^ 2)
}
# the length of a quadratic piece of a curve, by Gauss' rule of three points
function lengthOf(e,   k, s, t, w, dx, dy) {
  for (k = -1; k <= 1; k++) {
    s = k * sqrt(0.6)
    w = k ? 5 / 18 : 8 / 18
    dx = (s - 0.5) * X[e, 0] + (s + 0.5) * X[e, 1] - 2 * s * X[e, 2]
    dy = (s - 0.5) * Y[e, 0] + (s + 0.5) * Y[e, 1] - 2 * s * Y[e, 2]
    t += 2 * w * sqrt(dx * dx + dy * dy)
  }
  return t
}
# nodes of a face from its middle, over its size: at[1 ...], 3 each; how many; area, middle, size, moments of normals
function gather(f,   n, i, k, e, a, m, last_) {
  n = piecesOf(f, mine)
  areaOf[f] = mid[1] = mid[2] = mid[3] = 0
  for (k = 1; k <= 3; k++) { floor_[k] = 1e300; roof_[k] = -1e300; sumN[k] = 0 }
  for (k = 1; k <= 6; k++) momentN[k] = 0
  for (i = 1; i <= n; i++) {
    e = mine[i]
    if (space) {
      # at the middles of its sides, exact for the square
      m = (crossAt(e, 0.5, 0.5, 0) + crossAt(e, 0, 0.5, 0.5) + crossAt(e, 0.5, 0, 0.5)) / 6
      a = crossAt(e, 1 / 3, 1 / 3, 1 / 3) + 1e-300
      for (k = 1; k <= 3; k++) { crossed[k] /= a; sumN[k] += m * crossed[k] }
      for (k = 1; k <= 3; k++) { momentN[k] += m * crossed[k] ^ 2; momentN[3 + k] += m * crossed[k] * crossed[k % 3 + 1] }
      mid[1] += m * (X[e, 3] + X[e, 4] + X[e, 5]) / 3; mid[2] += m * (Y[e, 3] + Y[e, 4] + Y[e, 5]) / 3; mid[3] += m * (Z[e, 3] + Z[e, 4] + Z[e, 5]) / 3
    } else {
      m = lengthOf(e)
      mid[1] += m * (X[e, 0] + X[e, 1] + 4 * X[e, 2]) / 6; mid[2] += m * (Y[e, 0] + Y[e, 1] + 4 * Y[e, 2]) / 6
    }
    areaOf[f] += m
  }
  for (k = 1; k <= 3; k++) mid[k] /= areaOf[f] + 1e-300
  many_ = 0
  # a few hundred nodes tell a surface
  a = 1 + int(n / 60)
  for (i = 1; i <= n; i += a) {
    e = mine[i]
    last_ = straight[e] ? dim - 1 : (space ? 5 : 2)
    for (k = 0; k <= last_; k++) { many_++; at_[many_, 1] = X[e, k] - mid[1]; at_[many_, 2] = Y[e, k] - mid[2]; at_[many_, 3] = Z[e, k] - mid[3] }
  }
  for (i = 1; i <= many_; i++) for (k = 1; k <= 3; k++) { if (at_[i, k] < floor_[k]) floor_[k] = at_[i, k]; if (at_[i, k] > roof_[k]) roof_[k] = at_[i, k] }
  sizeF = sqrt((roof_[1] - floor_[1]) ^ 2 + (roof_[2] - floor_[2]) ^ 2 + (roof_[3] - floor_[3]) ^ 2) + 1e-300
  for (i = 1; i <= many_; i++) for (k = 1; k <= 3; k++) at_[i, k] /= sizeF
}
function put3(f, x0, y0, z0, u0, v0, w0) {
  spotOf[f, 1] = mid[1] + sizeF * x0; spotOf[f, 2] = mid[2] + sizeF * y0; spotOf[f, 3] = mid[3] + sizeF * z0
  wayOf[f, 1] = u0; wayOf[f, 2] = v0; wayOf[f, 3] = w0
}
function shape(f,   i, k, S, off, d, r) {
  if (f in kind_) return kind_[f]
  gather(f)
  kind_[f] = "other"
  put3(f, 0, 0, 0, 0, 0, 0)
  # a plane, a line
  for (k = 1; k <= 6; k++) S[k] = 0
  for (i = 1; i <= many_; i++) for (k = 1; k <= 3; k++) { S[k] += at_[i, k] ^ 2; S[3 + k] += at_[i, k] * at_[i, k % 3 + 1] }
  if (!space) S[3] = 1e3 * many_
  leastWay(S)
  for (i = 1; i <= many_; i++) { d = at_[i, 1] * least[1] + at_[i, 2] * least[2] + at_[i, 3] * least[3]; if (d * d > off) off = d * d }
  if (off < 1e-12) { kind_[f] = space ? "plane" : "line"; put3(f, 0, 0, 0, least[1], least[2], least[3]); return kind_[f] }
  if (!isSphere(f) && space) isCone(f)
  return kind_[f]
}
# a sphere, in the plane a circle: the square of the distance from its centre is linear in the centre
function isSphere(f,   i, k, v, r, d, n) {
  n = 2 + space
  clear(n + 1)
  for (i = 1; i <= many_; i++) {
    d = 0
    for (k = 1; k <= n; k++) { entry[k] = 2 * at_[i, k]; d += at_[i, k] ^ 2 }
    entry[n + 1] = 1
    addRow(n + 1, d)
  }
  if (!solve_(gram, rhs, n + 1, v)) return 0
  if (!space) { v[4] = v[3]; v[3] = 0 }
  r = v[4] + v[1] ^ 2 + v[2] ^ 2 + v[3] ^ 2
  if (r <= 0 || r > 1e6) return 0
  r = sqrt(r)
  for (i = 1; i <= many_; i++) {
    d = sqrt((at_[i, 1] - v[1]) ^ 2 + (at_[i, 2] - v[2]) ^ 2 + (at_[i, 3] - v[3]) ^ 2) - r
    if (d * d > 1e-12) return 0
  }
  kind_[f] = space ? "sphere" : "circle"
  radius[f] = r * sizeF
  put3(f, v[1], v[2], v[3], 0, 0, 0)
  if (space) areaOf[f] = onSphere(f)
  return 1
}
# the area of a face on a sphere: the solid angles of its pieces, each of four flat ones
function onSphere(f,   n, i, e, t) {
  n = piecesOf(f, mine)
  for (i = 1; i <= n; i++) {
    e = mine[i]
    if (straight[e]) t += solidAngle(f, e, 0, 1, 2)
    else t += solidAngle(f, e, 0, 3, 5) + solidAngle(f, e, 3, 1, 4) + solidAngle(f, e, 5, 4, 2) + solidAngle(f, e, 3, 4, 5)
  }
  return t * radius[f] ^ 2
}
# of the flat triangle of three nodes of piece e, seen from the centre (van Oosterom and Strackee, 1983)
function solidAngle(f, e, i, j, k,   a, b, c, la, lb, lc, det) {
  la = ray_(f, e, i, a); lb = ray_(f, e, j, b); lc = ray_(f, e, k, c)
  det = a[1] * (b[2] * c[3] - b[3] * c[2]) + a[2] * (b[3] * c[1] - b[1] * c[3]) + a[3] * (b[1] * c[2] - b[2] * c[1])
  return 2 * atan2(det < 0 ? -det : det, la * lb * lc + dot_(a, b) * lc + dot_(b, c) * la + dot_(c, a) * lb)
}
function ray_(f, e, i, a) {
  a[1] = X[e, i] - spotOf[f, 1]; a[2] = Y[e, i] - spotOf[f, 2]; a[3] = Z[e, i] - spotOf[f, 3]
  return sqrt(dot_(a, a))
}
function dot_(a, b) { return a[1] * b[1] + a[2] * b[2] + a[3] * b[3] }
# a cone, of which a cylinder is one: its normals make one angle with the axis; from there Newton's method on distances from the axis
function isCone(f,   i, k, j, S, a, e1, e2, p, v, d, t, w, q, r0, rise, off, most, ends) {
  for (k = 1; k <= 3; k++) { S[k] = momentN[k] / areaOf[f] - (sumN[k] / areaOf[f]) ^ 2; S[3 + k] = momentN[3 + k] / areaOf[f] - sumN[k] * sumN[k % 3 + 1] / areaOf[f] ^ 2 }
  leastWay(S)
  for (k = 1; k <= 3; k++) a[k] = least[k]
  across(a, e1, e2)
  clear(5)
  for (i = 1; i <= many_; i++) {
    entry[1] = 2 * (at_[i, 1] * e1[1] + at_[i, 2] * e1[2] + at_[i, 3] * e1[3]); entry[2] = 2 * (at_[i, 1] * e2[1] + at_[i, 2] * e2[2] + at_[i, 3] * e2[3])
    t = at_[i, 1] * a[1] + at_[i, 2] * a[2] + at_[i, 3] * a[3]
    entry[3] = 1; entry[4] = t; entry[5] = t * t
    addRow(5, (entry[1] ^ 2 + entry[2] ^ 2) / 4)
  }
  for (k = 1; k <= 5; k++) gram[k, k] += 1e-12 * many_
  if (!solve_(gram, rhs, 5, v)) return 0
  r0 = v[3] + v[1] ^ 2 + v[2] ^ 2
  if (r0 <= 0) return 0
  r0 = sqrt(r0)
  rise = v[4] / (2 * r0)
  for (k = 1; k <= 3; k++) p[k] = v[1] * e1[k] + v[2] * e2[k]
  for (j = 0; j < 12; j++) {
    across(a, e1, e2)
    clear(6)
    most = 0
    for (i = 1; i <= many_; i++) {
      t = d = 0
      for (k = 1; k <= 3; k++) { q[k] = at_[i, k] - p[k]; t += q[k] * a[k] }
      for (k = 1; k <= 3; k++) { w[k] = q[k] - t * a[k]; d += w[k] ^ 2 }
      d = sqrt(d) + 1e-300
      off = d - r0 - rise * t
      if (off * off > most) most = off * off
      entry[1] = (w[1] * e1[1] + w[2] * e1[2] + w[3] * e1[3]) / d
      entry[2] = (w[1] * e2[1] + w[2] * e2[2] + w[3] * e2[3]) / d
      entry[3] = t * entry[1] + rise * (q[1] * e1[1] + q[2] * e1[2] + q[3] * e1[3])
      entry[4] = t * entry[2] + rise * (q[1] * e2[1] + q[2] * e2[2] + q[3] * e2[3])
      entry[5] = 1; entry[6] = t
      addRow(6, off)
    }
    if (most < 1e-18 && j > 2) break
    for (k = 1; k <= 6; k++) gram[k, k] *= 1 + 1e-9
    if (!solve_(gram, rhs, 6, v)) return 0
    for (k = 1; k <= 3; k++) { p[k] += v[1] * e1[k] + v[2] * e2[k]; a[k] += v[3] * e1[k] + v[4] * e2[k] }
    r0 += v[5]; rise += v[6]
    d = sqrt(a[1] ^ 2 + a[2] ^ 2 + a[3] ^ 2)
    for (k = 1; k <= 3; k++) a[k] /= d
  }
  if (most > 1e-12 || r0 <= 0 || r0 > 1e6) return 0
  # beside the middle
  t = p[1] * a[1] + p[2] * a[2] + p[3] * a[3]
  for (k = 1; k <= 3; k++) p[k] -= t * a[k]
  r0 -= rise * t
  kind_[f] = rise * rise < 1e-11 ? "cylinder" : "cone"
  radius[f] = r0 * sizeF
  if (kind_[f] == "cone") tilt[f] = atan2(rise < 0 ? -rise : rise, 1)
  put3(f, p[1], p[2], p[3], a[1], a[2], a[3])
  return 1
}
# two directions across a
function across(a, e1, e2,   k, l) {
  k = 1
  for (l = 2; l <= 3; l++) if (a[l] ^ 2 < a[k] ^ 2) k = l
  for (l = 1; l <= 3; l++) e1[l] = (l == k) - a[l] * a[k]
  l = sqrt(e1[1] ^ 2 + e1[2] ^ 2 + e1[3] ^ 2)
  for (k = 1; k <= 3; k++) e1[k] /= l
  for (k = 1; k <= 3; k++) e2[k] = a[k % 3 + 1] * e1[(k + 1) % 3 + 1] - a[(k + 1) % 3 + 1] * e1[k % 3 + 1]
}
# which way is out of the first body, by how often a ray from a flat piece meets the body's other pieces: a normal outwards, a bore
function outward(f,   e, i, n, list, most, large, body, in_, d, c, k, s, v, own) {
  v = 0
  for (k = 1; k <= 3; k++) if (!v && wayOf[f, k] ^ 2 > 1e-12) v = wayOf[f, k]
  if (v < 0) for (k = 1; k <= 3; k++) wayOf[f, k] *= -1
  for (k = 1; k <= 3; k++) if (wayOf[f, k] ^ 2 < 1e-18) wayOf[f, k] = 0
  if (split(sidesOf[f], body, " ") == 0) return kind_[f]
  n = piecesOf(f, list)
  for (i = 1; i <= n; i++) { ball(list[i]); if (reach[list[i]] > most) { most = reach[list[i]]; large = list[i] } }
  e = large
  # its flat normal and middle
  d[1] = space ? (Y[e, 1] - Y[e, 0]) * (Z[e, 2] - Z[e, 0]) - (Z[e, 1] - Z[e, 0]) * (Y[e, 2] - Y[e, 0]) : Y[e, 1] - Y[e, 0]
  d[2] = space ? (Z[e, 1] - Z[e, 0]) * (X[e, 2] - X[e, 0]) - (X[e, 1] - X[e, 0]) * (Z[e, 2] - Z[e, 0]) : X[e, 0] - X[e, 1]
  d[3] = space ? (X[e, 1] - X[e, 0]) * (Y[e, 2] - Y[e, 0]) - (Y[e, 1] - Y[e, 0]) * (X[e, 2] - X[e, 0]) : 0
  n = split(around[body[1]], own, " ")
  for (i = 1; i <= n; i++) for (k = first[own[i]]; k != "" && k <= last[own[i]]; k++) if (face[k] == own[i] && k != e && meets_(e, d, k)) in_ = !in_
  s = in_ ? -1 : 1
  if (kind_[f] ~ /^(plane|line)$/) {
    c = d[1] * wayOf[f, 1] + d[2] * wayOf[f, 2] + d[3] * wayOf[f, 3]
    if (s * c < 0) for (k = 1; k <= 3; k++) wayOf[f, k] *= -1
  } else {
    # from the centre, or the axis, to the piece
    c = d[1] * (CX[e] - spotOf[f, 1]) + d[2] * (CY[e] - spotOf[f, 2]) + d[3] * (CZ[e] - spotOf[f, 3])
    if (kind_[f] ~ /^c[yo]/) {
      k = wayOf[f, 1] * (CX[e] - spotOf[f, 1]) + wayOf[f, 2] * (CY[e] - spotOf[f, 2]) + wayOf[f, 3] * (CZ[e] - spotOf[f, 3])
      c -= k * (d[1] * wayOf[f, 1] + d[2] * wayOf[f, 2] + d[3] * wayOf[f, 3])
    }
    hollow[f] = s * c < 0
  }
  return kind_[f]
}
# does the ray from the flat piece e along d, a little aslant, meet the flat piece k?
function meets_(e, d, k,   a, b, q, r, h, det, u, v, t, j, size) {
  size = sqrt(d[1] ^ 2 + d[2] ^ 2 + d[3] ^ 2)
  r[1] = d[1] / size + 0.0123; r[2] = d[2] / size - 0.0217; r[3] = space ? d[3] / size + 0.0171 : 0
  if (!space) {
    a[1] = X[k, 1] - X[k, 0]; a[2] = Y[k, 1] - Y[k, 0]
    q[1] = (X[e, 0] + X[e, 1]) / 2 - X[k, 0]; q[2] = (Y[e, 0] + Y[e, 1]) / 2 - Y[k, 0]
    det = r[1] * a[2] - r[2] * a[1]
    if (det == 0) return 0
    t = (a[1] * q[2] - a[2] * q[1]) / det
    u = (r[1] * q[2] - r[2] * q[1]) / det
    return t > 0 && u >= 0 && u < 1
  }
  a[1] = X[k, 1] - X[k, 0]; a[2] = Y[k, 1] - Y[k, 0]; a[3] = Z[k, 1] - Z[k, 0]
  b[1] = X[k, 2] - X[k, 0]; b[2] = Y[k, 2] - Y[k, 0]; b[3] = Z[k, 2] - Z[k, 0]
  q[1] = (X[e, 0] + X[e, 1] + X[e, 2]) / 3 - X[k, 0]; q[2] = (Y[e, 0] + Y[e, 1] + Y[e, 2]) / 3 - Y[k, 0]; q[3] = (Z[e, 0] + Z[e, 1] + Z[e, 2]) / 3 - Z[k, 0]
  h[1] = r[2] * b[3] - r[3] * b[2]; h[2] = r[3] * b[1] - r[1] * b[3]; h[3] = r[1] * b[2] - r[2] * b[1]
  det = a[1] * h[1] + a[2] * h[2] + a[3] * h[3]
  if (det == 0) return 0
  u = (q[1] * h[1] + q[2] * h[2] + q[3] * h[3]) / det
  if (u < 0 || u > 1) return 0
  h[1] = q[2] * a[3] - q[3] * a[2]; h[2] = q[3] * a[1] - q[1] * a[3]; h[3] = q[1] * a[2] - q[2] * a[1]
  v = (r[1] * h[1] + r[2] * h[2] + r[3] * h[3]) / det
  return v >= 0 && u + v <= 1 && (b[1] * h[1] + b[2] * h[2] + b[3] * h[3]) / det > 0
}
