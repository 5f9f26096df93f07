# gnuplot script; run it in its own folder: gnuplot 'cost.gp'
set encoding utf8
set title 'Cost of both engines'
set xlabel 'number of grains'
set logscale x
set format x '10^{%L}'
set mxtics 10
set xrange [800:1250000]
set ylabel 'ns per grain and step'
set logscale y
set format y '10^{%L}'
set mytics 10
set yrange [30.4:3658.875]
set autoscale noextend
set offsets 0, 0, 0, 0
set grid xtics ytics linecolor rgb '#d8d8d8' linewidth 0.7 linetype 1
set border linewidth 1.2
set errorbars 0.8
set key outside below center horizontal Left reverse samplen 2.5 height 0.8 spacing 1.1
set terminal svg size 800,628 font 'DejaVu Sans,15' background rgb 'white' enhanced
set output './cost.svg'
plot './cost.dat' index 0 using 1:2 with linespoints linecolor rgb '#0072b2' pointtype 7 pointsize 0.7 linewidth 1.5 title 'md, shear of equal spheres', \
     './cost.dat' index 1 using 1:2 with points linecolor rgb '#d55e00' pointtype 5 pointsize 0.7 linewidth 1.5 title 'md, sizes 1:1', \
     './cost.dat' index 2 using 1:2 with points linecolor rgb '#009e73' pointtype 9 pointsize 0.7 linewidth 1.5 title 'md, sizes 1:10', \
     './cost.dat' index 3 using 1:2 with points linecolor rgb '#cc79a7' pointtype 13 pointsize 0.7 linewidth 1.5 title 'md, sizes 1:50', \
     './cost.dat' index 4 using 1:2 with linespoints linecolor rgb '#e69f00' pointtype 11 pointsize 0.7 linewidth 1.5 title 'cd, shear of equal spheres', \
     './cost.dat' index 5 using 1:2 with points linecolor rgb '#56b4e9' pointtype 15 pointsize 0.7 linewidth 1.5 title 'cd, sizes 1:1', \
     './cost.dat' index 6 using 1:2 with points linecolor rgb '#000000' pointtype 6 pointsize 0.7 linewidth 1.5 title 'cd, sizes 1:10', \
     './cost.dat' index 7 using 1:2 with points linecolor rgb '#888888' pointtype 4 pointsize 0.7 linewidth 1.5 title 'cd, sizes 1:50'
if (strstrt(GPVAL_TERMINALS, 'pngcairo') > 0) {
  set terminal pngcairo size 1600,1256 font 'DejaVu Sans,15' fontscale 2 linewidth 2 pointscale 2 enhanced
} else {
  set terminal png size 800,600 enhanced
}
set output './cost.png'
replot
set output
