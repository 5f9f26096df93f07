# gnuplot script; run it in its own folder: gnuplot 'effects_md.gp'
set encoding utf8
set title 'Effects of six parameters in six regimes (md) (quick size)'
set xlabel '1 assembly, 2 type I, 3 type II, 4 critical, 5 dense flow, 6 collisional'
set ylabel 'effect / what counts as one'
set logscale y
set format y '10^{%L}'
set mytics 10
set yrange [0.0010145017326229262:35.688400092785805]
set autoscale noextend
set offsets graph 0.03, graph 0.03, 0, 0
set grid xtics ytics linecolor rgb '#d8d8d8' linewidth 0.7 linetype 1
set border linewidth 1.2
set errorbars 0.8
set key outside below center horizontal Left reverse samplen 2.5 height 0.8 spacing 1.1
set terminal svg size 800,606 font 'DejaVu Sans,15' background rgb 'white' enhanced
set output './effects_md.svg'
plot './effects_md.dat' index 0 using 1:2 with linespoints linecolor rgb '#0072b2' pointtype 7 pointsize 0.7 linewidth 1.5 title '1: from here on Y', \
     './effects_md.dat' index 1 using 1:2:3 with yerrorbars linecolor rgb '#d55e00' pointtype 5 pointsize 0.7 linewidth 1.5 title 'I', \
     './effects_md.dat' index 2 using 1:2:3 with yerrorbars linecolor rgb '#009e73' pointtype 9 pointsize 0.7 linewidth 1.5 title 'kappa', \
     './effects_md.dat' index 3 using 1:2:3 with yerrorbars linecolor rgb '#cc79a7' pointtype 13 pointsize 0.7 linewidth 1.5 title 'e', \
     './effects_md.dat' index 4 using 1:2:3 with yerrorbars linecolor rgb '#e69f00' pointtype 11 pointsize 0.7 linewidth 1.5 title 'mu', \
     './effects_md.dat' index 5 using 1:2:3 with yerrorbars linecolor rgb '#56b4e9' pointtype 15 pointsize 0.7 linewidth 1.5 title 'mu_R/d', \
     './effects_md.dat' index 6 using 1:2:3 with yerrorbars linecolor rgb '#000000' pointtype 6 pointsize 0.7 linewidth 1.5 title 'eta'
if (strstrt(GPVAL_TERMINALS, 'pngcairo') > 0) {
  set terminal pngcairo size 1600,1212 font 'DejaVu Sans,15' fontscale 2 linewidth 2 pointscale 2 enhanced
} else {
  set terminal png size 800,600 enhanced
}
set output './effects_md.png'
replot
set output
