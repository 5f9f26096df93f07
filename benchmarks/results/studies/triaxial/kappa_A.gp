# gnuplot script; run it in its own folder: gnuplot 'kappa_A.gp'
set encoding utf8
set title 'Stiffness levels of state A (md, mu = 0.3) (quick size)'
set xlabel 'axial strain'
set ylabel 'q / P'
set autoscale noextend
set offsets graph 0.03, graph 0.03, graph 0.03, graph 0.03
set grid xtics ytics linecolor rgb '#d8d8d8' linewidth 0.7 linetype 1
set border linewidth 1.2
set errorbars 0.8
set key outside below center horizontal Left reverse samplen 2.5 height 0.8 spacing 1.1
set terminal svg size 800,562 font 'DejaVu Sans,15' background rgb 'white' enhanced
set output './kappa_A.svg'
plot './kappa_A.dat' index 0 using 1:2 with linespoints linecolor rgb '#0072b2' pointtype 7 pointsize 0.7 linewidth 1.5 title 'kappa = 8400', \
     './kappa_A.dat' index 1 using 1:2 with linespoints linecolor rgb '#d55e00' pointtype 5 pointsize 0.7 linewidth 1.5 title 'kappa = 39000', \
     './kappa_A.dat' index 2 using 1:2 with linespoints linecolor rgb '#009e73' pointtype 9 pointsize 0.7 linewidth 1.5 title 'kappa = 1800'
if (strstrt(GPVAL_TERMINALS, 'pngcairo') > 0) {
  set terminal pngcairo size 1600,1124 font 'DejaVu Sans,15' fontscale 2 linewidth 2 pointscale 2 enhanced
} else {
  set terminal png size 800,600 enhanced
}
set output './kappa_A.png'
replot
set output
