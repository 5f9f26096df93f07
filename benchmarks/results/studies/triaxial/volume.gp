# gnuplot script; run it in its own folder: gnuplot 'volume.gp'
set encoding utf8
set title 'Triaxial compression of spheres, kappa = 8400 or rigid (quick size)'
set xlabel 'axial strain'
set ylabel 'volume strain'
set autoscale noextend
set offsets graph 0.03, graph 0.03, graph 0.03, graph 0.03
set grid xtics ytics linecolor rgb '#d8d8d8' linewidth 0.7 linetype 1
set border linewidth 1.2
set errorbars 0.8
set key outside below center horizontal Left reverse samplen 2.5 height 0.8 spacing 1.1
set terminal svg size 800,584 font 'DejaVu Sans,15' background rgb 'white' enhanced
set output './volume.svg'
plot './volume.dat' index 0 using 1:2 with linespoints linecolor rgb '#0072b2' pointtype 7 pointsize 0.7 linewidth 1.5 title 'md, A, mu = 0', \
     './volume.dat' index 1 using 1:2 with linespoints linecolor rgb '#d55e00' pointtype 5 pointsize 0.7 linewidth 1.5 title 'md, A, mu = 0.3', \
     './volume.dat' index 2 using 1:2 with linespoints linecolor rgb '#009e73' pointtype 9 pointsize 0.7 linewidth 1.5 title 'md, A, mu = 0.5', \
     './volume.dat' index 3 using 1:2 with linespoints linecolor rgb '#cc79a7' pointtype 13 pointsize 0.7 linewidth 1.5 title 'md, A, mu = 1', \
     './volume.dat' index 4 using 1:2 with linespoints linecolor rgb '#e69f00' pointtype 11 pointsize 0.7 linewidth 1.5 title 'md, C, mu = 0.3', \
     './volume.dat' index 5 using 1:2 with linespoints linecolor rgb '#56b4e9' pointtype 15 pointsize 0.7 linewidth 1.5 title 'cd, A, mu = 0.3'
if (strstrt(GPVAL_TERMINALS, 'pngcairo') > 0) {
  set terminal pngcairo size 1600,1168 font 'DejaVu Sans,15' fontscale 2 linewidth 2 pointscale 2 enhanced
} else {
  set terminal png size 800,600 enhanced
}
set output './volume.png'
replot
set output
