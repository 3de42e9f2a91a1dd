# touch.awk: the table of -check 1, and bodies of a geometry whose faces lie on each other: read after pick.awk and kinds.awk
# Needs: TABLE, a file to be written, or nothing; TOUCH, a file to be written.
# Gives: tell(): TABLE, bodies and faces with their kinds and neighbours, and the pairs of bodies that touch, with the statements that
#        say what they are;  touching(): touch_[a, b] the pairs of faces;  tellCut(name, body, faces): a line more;  warnOfTouch(): TOUCH, a line for each pair of bodies of which
#        no statement of the case says anything. Two faces lie on each other if they are of one kind, at one place, within 1e-6 of the
#        whole, and a piece of one lies inside the other, with opposite normals; those of kind other, if they have one area and one middle.
function boxOf(f,   n, i, k, e, list) {
  if ((f, 0) in boxLow) return
  for (k = 0; k < 3; k++) { boxLow[f, k] = 1e300; boxHigh[f, k] = -1e300 }
  n = piecesOf(f, list)
  for (i = 1; i <= n; i++) for (k = 0; k < (space ? 6 : 3); k++) {
    e = list[i]
    if (X[e, k] < boxLow[f, 0]) boxLow[f, 0] = X[e, k] + 0
    if (X[e, k] > boxHigh[f, 0]) boxHigh[f, 0] = X[e, k] + 0
    if (Y[e, k] < boxLow[f, 1]) boxLow[f, 1] = Y[e, k] + 0
    if (Y[e, k] > boxHigh[f, 1]) boxHigh[f, 1] = Y[e, k] + 0
    if (Z[e, k] < boxLow[f, 2]) boxLow[f, 2] = Z[e, k] + 0
    if (Z[e, k] > boxHigh[f, 2]) boxHigh[f, 2] = Z[e, k] + 0
  }
}
function nearBoxes(f, g,   k, t) {
  boxOf(f); boxOf(g)
  t = 1e-6 * diagonal
  for (k = 0; k < 2 + space; k++) if (boxLow[f, k] > boxHigh[g, k] + t || boxLow[g, k] > boxHigh[f, k] + t) return 0
  return 1
}
# one plane, cylinder, ...: within 1e-6 of the whole
function oneShape(f, g,   k, t, d, c, along_, off, slant) {
  shape(f); shape(g)
  if (kind_[f] != kind_[g]) return 0
  t = 1e-6 * diagonal
  for (k = 1; k <= 3; k++) { d[k] = spotOf[g, k] - spotOf[f, k]; c += wayOf[f, k] * wayOf[g, k]; along_ += d[k] * wayOf[f, k]; off += d[k] ^ 2 }
  if (kind_[f] == "other") return off < (1e-4 * diagonal) ^ 2 && (areaOf[f] - areaOf[g]) ^ 2 < (1e-4 * areaOf[f]) ^ 2
  if (kind_[f] ~ /^(sphere|circle)$/) return off < t * t && (radius[f] - radius[g]) ^ 2 < t * t
  if (1 - c * c > 1e-10) return 0
  if (kind_[f] ~ /^(plane|line)$/) return along_ ^ 2 < t * t
  if (off - along_ ^ 2 > t * t) return 0
  if ((tilt[f] - tilt[g]) ^ 2 > 1e-10) return 0
  slant = kind_[f] == "cone" ? sin(tilt[f]) / cos(tilt[f]) : 0
  if (radius[g] < radius[f] && along_ > 0 || radius[g] > radius[f] && along_ < 0) slant = -slant
  return (radius[g] - radius[f] - slant * along_) ^ 2 < 4 * t * t
}
# does a quarter of a piece of f, in the plane a half, lie on g?
function partOn(f, g,   A, B, n, m, i, j, k, r, q, t, b, cx, cy, cz, wide, cell, near, ix, iy, iz, w) {
  n = piecesOf(f, A); m = piecesOf(g, B)
  pieces = pieces < elements ? elements : pieces
  t = 1e-6 * diagonal
  for (j = 1; j <= m; j++) {
    b = B[j]
    ball(b)
    if (!(b in play_)) play_[b] = t + 1.2 * bow(b)
    if (reach[b] > wide) wide = reach[b]
  }
  # cells as wide as the largest piece reaches: those around a place have all that may hold it
  wide += t
  for (j = 1; j <= m; j++) { b = cellAt(B[j], wide); cell[b] = cell[b] " " B[j] }
  for (i = 1; i <= n; i++) {
    if (!(A[i] in play_)) play_[A[i]] = t + 1.2 * bow(A[i])
    q = split_(A[i])
    for (r = q; r < q + (space ? 4 : 2); r++) {
      ball(r)
      cx = CX[r]; cy = CY[r]; cz = CZ[r]
      if (cx < boxLow[g, 0] - t || cx > boxHigh[g, 0] + t || cy < boxLow[g, 1] - t || cy > boxHigh[g, 1] + t || cz < boxLow[g, 2] - t || cz > boxHigh[g, 2] + t) continue
      near = ""
      for (ix = -1; ix <= 1; ix++) for (iy = -1; iy <= 1; iy++) for (iz = -space; iz <= space; iz++) {
        b = cellOf(cx, wide) + ix " " cellOf(cy, wide) + iy " " cellOf(cz, wide) + iz
        if (b in cell) near = near cell[b]
      }
      k = split(near, w, " ")
      for (j = 1; j <= k; j++) {
        b = w[j]
        if ((cx - CX[b]) ^ 2 + (cy - CY[b]) ^ 2 + (cz - CZ[b]) ^ 2 > reach[b] ^ 2) continue
        if (along(A[i], b) && away(cx, cy, cz, b) < play_[A[i]] + play_[b]) return 1
      }
    }
  }
  return 0
}
# do faces of one shape look at each other? flush ones, with one outward normal, share an edge at most
function opposite(f, g,   k, c, w) {
  if (kind_[f] == "other" || split(sidesOf[f], w, " ") != 1 || split(sidesOf[g], w, " ") != 1) return 1
  outward(f); outward(g)
  if (kind_[f] !~ /^(plane|line)$/) return hollow[f] != hollow[g]
  for (k = 1; k <= 3; k++) c += wayOf[f, k] * wayOf[g, k]
  return c < 0
}
function cellAt(p, wide) { return cellOf(CX[p], wide) " " cellOf(CY[p], wide) " " cellOf(CZ[p], wide) }
function cellOf(v, wide) { v /= wide; return v < 0 ? -int(-v) - 1 : int(v) }
function touching(   n, w, i, j, a, b, k, l, nf, ng, F, G) {
  n = split(entities[dim], w, " ")
  for (i = 1; i < n; i++)
    for (j = i + 1; j <= n; j++) {
      a = w[i]; b = w[j]
      nf = split(around[a], F, " "); ng = split(around[b], G, " ")
      for (k = 1; k <= nf; k++)
        for (l = 1; l <= ng; l++)
          if (F[k] != G[l] && nearBoxes(F[k], G[l]) && (ENVIRON["TABLE"] != "" || !isStated(a, b, F[k], G[l])) && oneShape(F[k], G[l]) && (partOn(F[k], G[l]) || partOn(G[l], F[k])) && opposite(F[k], G[l])) {
            if (!((a, b) in touch_)) touchAt[++touches_] = a SUBSEP b
            touch_[a, b] = touch_[a, b] " " F[k] "," G[l]
            meets[F[k]] = meets[F[k]] " " G[l]
            meets[G[l]] = meets[G[l]] " " F[k]
          }
    }
}
# does a contact have face f on one side, g on the other? are the bodies joined?
function isStated(a, b, f, g,   k, p, q, w) {
  for (k = 1; k <= joins; k++) {
    split(joinLine[k], w, "\t")
    p = members[dim, w[3]] " "; q = members[dim, w[4]] " "
    if (index(p, " " a " ") && index(q, " " b " ") || index(p, " " b " ") && index(q, " " a " ")) return 1
  }
  for (k = 1; k <= contacts; k++) {
    if (k in obstacle) continue
    split(contact[k], w, "\t")
    p = members[dim - 1, w[1]] " "; q = members[dim - 1, w[2]] " "
    if (index(p, " " f " ") && index(q, " " g " ") || index(p, " " g " ") && index(q, " " f " ")) return 1
  }
  return 0
}
# the name of a body in the case, or its number
function calledBody(v,   key, d, found) {
  for (key in members) { split(key, d, SUBSEP); if (d[1] == dim && members[key] == " " v) found = d[2] }
  return found
}
function warnOfTouch(   k, p, n, w, i, fg, text, a, b) {
  for (k = 1; k <= touches_; k++) {
    split(touchAt[k], p, SUBSEP)
    if (left_(p[1]) || left_(p[2])) continue
    n = split(touch_[p[1], p[2]], w, " ")
    text = ""
    for (i = 1; i <= n; i++) { split(w[i], fg, ","); if (!isStated(p[1], p[2], fg[1], fg[2])) text = text (text == "" ? "" : ", ") fg[1] " on " fg[2] }
    if (text == "") continue
    a = calledBody(p[1]); b = calledBody(p[2])
    print (a == "" || b == "" ? many[dim] " " p[1] " and " p[2] : a " and " b) " (" many[dim - 1] " " text "), and no statement says what happens there: " \
      (a == "" || b == "" ? "name each by a line group NAME " many[dim] " N, and " : "") "write join " (a == "" || b == "" ? "A B" : a " " b) " part, tie or contact" > ENVIRON["TOUCH"]
  }
}
function left_(v,   key, d) {
  for (key in members) { split(key, d, SUBSEP); if (d[1] == dim && index(members[key] " ", " " v " ")) return 0 }
  return 1
}
# 0 where that is rounding, against the whole: the middle of a plane with curved sides has the outline's error
function clean_(v, part) { return v * v < (part * diagonal) ^ 2 ? 0 : v }
function triple(a, f, part,   k, t, text) {
  for (k = 1; k <= 2 + space; k++) {
    t = part ? clean_(a[f, k], part) : (a[f, k] ^ 2 < 1e-14 ? 0 : a[f, k])
    text = text (k > 1 ? " " : "") sprintf(part < 1e-5 ? "%.6g" : "%.4g", t)
  }
  return text
}
function corner(low_,   k, text) {
  for (k = 0; k < 2 + space; k++) text = text (k ? ", " : "") sprintf("%.6g", clean_(low_[k], 1e-6))
  return "(" text ")"
}
function areaOf_(pairs, n, side,   i, fg, t) {
  for (i = 1; i <= n; i++) { split(pairs[i], fg, ","); t += areaOf[fg[side]] }
  return t
}
function tell(   out, n, w, i, f, k, j, p, m, d, b, low_, high_, text, line, fg, a) {
  out = ENVIRON["TABLE"]
  n = split(entities[dim], w, " ")
  for (i = 1; i <= n; i++) {
    m = split(around[w[i]], d, " ")
    for (k = 0; k < 3; k++) { low_[k] = 1e300; high_[k] = -1e300 }
    for (j = 1; j <= m; j++) { boxOf(d[j]); for (k = 0; k < 3; k++) { if (boxLow[d[j], k] < low_[k]) low_[k] = boxLow[d[j], k]; if (boxHigh[d[j], k] > high_[k]) high_[k] = boxHigh[d[j], k] } }
    text = calledBody(w[i])
    print (space ? "volume " : "surface ") w[i] (text == "" ? "" : " (" text ")") ": from " corner(low_) " to " corner(high_) ", " many[dim - 1] around[w[i]] > out
  }
  printf "\n%6s  %-15s %-30s %-30s %10s %10s  %s\n", space ? "face" : "curve", "kind", space ? "middle, centre or on the axis" : "middle or centre", space ? "normal outwards or axis" : "normal outwards", "radius", space ? "area" : "length", "of; on" > out
  n = split(entities[dim - 1], w, " ")
  for (i = 1; i <= n; i++) {
    f = w[i]
    if (!(f in first)) continue
    k = shape(f)
    if (k != "other") outward(f)
    text = sidesOf[f]
    sub(/^ /, "", text)
    gsub(/ /, " and ", text)
    if (f in meets) text = text "; on" meets[f]
    line = k (hollow[f] ? (k == "circle" ? " hole" : " hollow") : "")
    if (tilt[f]) line = line sprintf(" %.4g deg", tilt[f] * 45 / atan2(1, 1))
    printf "%6s  %-15s %-30s %-30s %10s %10s  %s\n", f, line, triple(spotOf, f, k ~ /^(plane|line|other)$/ ? 3e-5 : 1e-7), k ~ /^(other|sphere|circle)$/ ? "-" : triple(wayOf, f, 0), (f in radius) ? sprintf("%.6g", radius[f]) : "-", sprintf("%.4g", areaOf[f]), text > out
  }
  for (k = 1; k <= touches_; k++) {
    split(touchAt[k], p, SUBSEP)
    m = split(touch_[touchAt[k]], d, " ")
    text = ""
    for (i = 1; i <= m; i++) { split(d[i], fg, ","); text = text (text == "" ? "" : ", ") fg[1] " on " fg[2] }
    line = "\n" many[dim] " " p[1] " and " p[2] " touch (" many[dim - 1] " " text "): "
    for (i = 1; i <= m; i++) { split(d[i], fg, ","); if (!isStated(p[1], p[2], fg[1], fg[2])) break }
    if (i > m) { print line "the case file says how" > out; continue }
    print line "nothing joins them until the case file says how" > out
    a = calledBody(p[1]); b = calledBody(p[2])
    line = ""
    if (a == "") { a = "V" p[1]; line = line "  group " a " " many[dim] " " p[1] "\n" }
    if (b == "") { b = "V" p[2]; line = line "  group " b " " many[dim] " " p[2] "\n" }
    if (line != "") printf "%s", line > out
    # the slave first: the smaller face
    if (areaOf_(d, m, 1) > areaOf_(d, m, 2)) { text = a; a = b; b = text }
    print "  join " a " " b " part      # one part: they share nodes\n  join " a " " b " tie       # glued, each with its own nodes\n  join " a " " b " contact   # they may part and slide" > out
  }
  close(out)
}
# a line for the faces of a cut, where the bodies have been cut
function tellCut(name, body, faces,   n, w, k, area) {
  n = split(faces, w, " ")
  for (k = 1; k <= n; k++) { shape(w[k]); area += areaOf[w[k]] }
  print "\ncut " name " through " body ": " (space ? "area " : "length ") sprintf("%.4g", area) ", middle " triple(spotOf, w[1], 3e-5) >> ENVIRON["TABLE"]
}
