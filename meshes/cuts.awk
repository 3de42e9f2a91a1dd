# cuts.awk: the sides of a mesh that a case file cuts a body by: awk -f msh.awk -f parts.awk -f cuts.awk < FILE.msh
# Needs: parts.awk's elements and their sides, the statements "cut" of its TABLE.
# Gives: readCut(w): one of them;  checkCuts(): the sides between elements of the body that lie in the plane become the cut's. The
#        plane goes through no element: a body's elements on both sides of it meet there. A geometry is cut so before it is meshed
#        (cad.awk); of a finished mesh that is so where it has a layer of sides in the plane.
function readCut(w,   k, size) {
  planes++
  planeGroup[planes] = w[3]
  planeBody[planes] = w[4]
  planeLine[planes] = w[2]
  size = sqrt(w[11] * w[11] + w[12] * w[12] + w[13] * w[13])
  for (k = 1; k <= 3; k++) { planeAt[planes, k] = w[7 + k] + 0; planeTo[planes, k] = w[10 + k] / size }
}
function height(c, p) {
  return (x[p] - planeAt[c, 1]) * planeTo[c, 1] + (y[p] - planeAt[c, 2]) * planeTo[c, 2] + (space ? (z[p] - planeAt[c, 3]) * planeTo[c, 3] : 0)
}
# below 0, in the plane, above
function level(c, p,   h) {
  if (!((c, p) in levelAt)) { h = height(c, p); levelAt[c, p] = h > 1e-7 * size ? 1 : (h < -1e-7 * size ? -1 : 0) }
  return levelAt[c, p]
}
function checkCuts(   c, i, k, n, a, b, d, s, w, v, through, g, most, least, h) {
  for (c = 1; c <= planes; c++) {
    g = planeGroup[c]
    through = 0; most = least = ""
    split("", onCut_)
    for (i = 1; i <= elements; i++) {
      if (bodyOf[i] != planeBody[c]) continue
      v[1] = c1[i]; v[2] = c2[i]; v[3] = c3[i]; v[4] = c4[i]
      a = b = 0
      for (k = 1; k <= dim + 1; k++) {
        d = level(c, v[k])
        if (d < 0) a = 1
        if (d > 0) b = 1
        h = height(c, v[k])
        if (most == "" || h > most) most = h
        if (least == "" || h < least) least = h
      }
      if (a && b) { through++; if (!firstThrough[c]) firstThrough[c] = elementNumber[i] }
    }
    if (most <= 1e-7 * size || least >= -1e-7 * size)
      fail("cut \"" name[g] "\" of the case file, line " planeLine[c] ": the plane does not cross \"" name[planeBody[c]] sprintf("\", which lies from %.4g to %.4g along the normal from its point; allowed: a point between", least, most))
    if (through)
      fail("cut \"" name[g] "\" of the case file, line " planeLine[c] ": the plane goes through " through " elements, the first is " firstThrough[c] "; allowed: a geometry (STEP, BREP, .geo), which is cut before it is meshed, or a mesh that has sides of elements in the plane")
    for (s in owner) {
      if (tip[s] != 0 || bodyOf[owner[s]] != planeBody[c]) continue
      n = split(s, w, " ")
      for (k = 1; k <= n; k++) if (level(c, w[k] + 0) != 0) break
      if (k <= n) continue
      for (k = 1; k <= n; k++) if (!((g, w[k]) in onCut)) { onCut[g, w[k]] = 1; cutAt[++cutNodes] = g " " w[k] }
      has[g] = 1
    }
    if (!(g in has)) fail("cut \"" name[g] "\" of the case file, line " planeLine[c] ": no two elements of \"" name[planeBody[c]] "\" meet in the plane; allowed: a plane through it")
  }
}
