# What each engine of a study costs at equal error, from its runs.csv, by the definitions of src/studies/costs.hpp.
#   observable  column that is judged
#   need        a column that must not be empty (default: any row)
#   flows       1: only the flows of the study of regimes (regime 4 to 6); 0: only its other rows (default: all)
#   samples     1: the error is that of samples whatever column is judged: only seconds of a sample are compared
# Prints cells of a table: states; geometric means of md's seconds, of cd's, of md / cd; least and largest md / cd.
BEGIN { FS = "," }
/^#/ { next }
!("name" in at) {
  for (k = 1; k <= NF; ++k) if (!($k in at)) at[$k] = k  # "dt" is a parameter of one study and a column of all
  last = at["mu_star"] - 1
  for (k = 3; k <= last; ++k) title[k] = $k  # parameters
  next
}
need != "" && $(at[need]) == "" { next }
flows != "" && ($(at["regime"]) >= 4) != flows { next }
flows != "" && $(at["changed"]) == 2 { next }  # kappa: another one in each engine
{
  state = ""; kappa = 0
  for (k = 3; k <= last; ++k)
    if (title[k] == "kappa_set") kappa = $k + 0
    else if (title[k] != "seed" && title[k] != "rigid") state = state "," $k
  group = $2 SUBSEP state SUBSEP kappa
  if (!(group in rows)) { engine[group] = $2; of[group] = state; level[group] = kappa; order[++groups] = group }
  value = $(at[observable]); ++rows[group]
  sum[group] += value; square[group] += value * value; seconds[group] += $(at["seconds"])
  error[group] = $(at[observable "_error"]); ending[group] = $(at["ending"])
}
function of_run(group) { return ending[group] == "equilibrium" ? 0 : seconds[group] * (100 * error[group] / sum[group]) ^ 2 }
function squares(group) { return square[group] * (rows[group] / sum[group]) ^ 2 - rows[group] }
END {
  for (c = 1; c <= groups; ++c) {
    cd = order[c]; md = ""
    if (engine[cd] != "cd") continue
    for (m = 1; m <= groups; ++m) {
      one = order[m]
      if (engine[one] == "md" && of[one] == of[cd] && (level[cd] > 0 ? level[one] == level[cd] : md == "" || level[one] > level[md])) md = one
    }
    if (md == "") continue
    freedoms = rows[md] + rows[cd] - 2
    if (samples || freedoms > 0) {
      a = seconds[md] / rows[md]; b = seconds[cd] / rows[cd]
      if (!samples) { variance = 1e4 * (squares(md) + squares(cd)) / freedoms; a *= variance; b *= variance }
    } else { a = of_run(md); b = of_run(cd) }
    if (!(a > 0 && b > 0)) continue
    ++pairs; soft += log(a); rigid += log(b)
    if (pairs == 1 || a / b < least) least = a / b
    if (pairs == 1 || a / b > most) most = a / b
  }
  if (pairs) printf "%d | %.2g | %.2g | %.2g | %.2g to %.2g\n", pairs, exp(soft / pairs), exp(rigid / pairs), exp((soft - rigid) / pairs), least, most
}
