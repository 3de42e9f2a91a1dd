# numbers.awk: numbers and their errors as text, for the screen
# Read by awk before output/report/screen.awk or input/case/rows/cases.awk. An error has two digits, its value as many decimals.
function floor(x,   i) { i = int(x); return i > x ? i - 1 : i }  # largest integer not above x
function absolute(x) { return x < 0 ? -x : x }
function roundDigits(x, n) { return sprintf("%." n "g", x) + 0 "" }  # x with n significant digits, as text
function decimalExponent(x) { return floor(log(x) / log(10) + 1e-9) }  # floor of log10 x
function decimalPlaces(x, error,   d) {  # decimals at which x is printed with this error; -1: significant digits instead
  if (error <= 0 || absolute(x) >= 1e9 || (x != 0 && absolute(x) < 1e-4)) return -1
  d = 1 - decimalExponent(error)
  if (d > 0 && absolute(x) * 10 ^ d >= 1e15) return -1
  return d < 0 ? 0 : d
}
function significantDigits(x, error,   n) {  # number of digits of x down to the second one of its error; six without an error
  n = error > 0 && x != 0 ? decimalExponent(absolute(x)) - decimalExponent(error) + 2 : 6
  return n < 1 ? 1 : (n > 15 ? 15 : n)
}
function valueText(x, error,   d, unit) {  # x rounded to the second digit of its error, as text
  if (error >= 100) { unit = 10 ^ (decimalExponent(error) - 1); return sprintf("%.0f", sprintf("%.0f", x / unit) * unit) }
  d = decimalPlaces(x, error)
  return d < 0 ? sprintf("%." significantDigits(x, error) "g", x) : sprintf("%." d "f", x)
}
function errorText(x, error,   d) {  # the error of x with two digits, as text
  d = decimalPlaces(x, error)
  return d < 0 || error >= 100 || error < 1e-4 ? roundDigits(error, 2) : sprintf("%." d "f", error)
}
function percentText(part, total,   p) { p = absolute(100 * part / total); return (p >= 1000 ? "more than 1000" : roundDigits(p, 2)) " %" }  # part/total in percent, as text
function bracketedPercent(part, total) { return total == 0 ? "" : "(" percentText(part, total) ")" }
function atLeastRounding(x, error) { return error > 0 && error < 1e-8 * absolute(x) ? 1e-8 * absolute(x) : error }  # the error, but at least 1e-8 of x: results of a solver are not more accurate
function errorExceedsValue(x, error) { return error > absolute(x) && x != 0 }
function unknownErrorText(x, error) { return "error not known (estimate " percentText(error, x) ")" }  # text for an error that exceeds its value
function threeDigits(x) { return valueText(x, 10 ^ (decimalExponent(absolute(x)) - 1)) }  # x with three digits, as text
