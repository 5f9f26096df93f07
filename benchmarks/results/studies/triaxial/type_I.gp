# gnuplot script; run it in its own folder: gnuplot 'type_I.gp'
set encoding utf8
set title 'Spheres of state A under a slowly raised deviator (quick size)'
set xlabel 'kappa times axial strain (rigid: kappa = 39000)'
set ylabel 'q / P'
set autoscale noextend
set offsets graph 0.03, graph 0.03, graph 0.03, graph 0.03
set grid xtics ytics linecolor rgb '#d8d8d8' linewidth 0.7 linetype 1
set border linewidth 1.2
set errorbars 0.8
set key outside below center horizontal Left reverse samplen 2.5 height 0.8 spacing 1.1
set terminal svg size 800,584 font 'DejaVu Sans,15' background rgb 'white' enhanced
set output './type_I.svg'
plot './type_I.dat' index 0 using 1:2 with linespoints linecolor rgb '#0072b2' pointtype 7 pointsize 0.7 linewidth 1.5 title 'md, kappa = 8400', \
     './type_I.dat' index 1 using 1:2 with linespoints linecolor rgb '#d55e00' pointtype 5 pointsize 0.7 linewidth 1.5 title 'md, kappa = 39000', \
     './type_I.dat' index 2 using 1:2 with linespoints linecolor rgb '#009e73' pointtype 9 pointsize 0.7 linewidth 1.5 title 'cd, elastic, kappa = 8400', \
     './type_I.dat' index 3 using 1:2 with linespoints linecolor rgb '#cc79a7' pointtype 13 pointsize 0.7 linewidth 1.5 title 'cd, rigid'
if (strstrt(GPVAL_TERMINALS, 'pngcairo') > 0) {
  set terminal pngcairo size 1600,1168 font 'DejaVu Sans,15' fontscale 2 linewidth 2 pointscale 2 enhanced
} else {
  set terminal png size 800,600 enhanced
}
set output './type_I.png'
replot
set output
