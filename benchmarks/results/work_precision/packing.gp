# gnuplot script; run it in its own folder: gnuplot 'packing.gp'
set encoding utf8
set title 'packing'
set xlabel 'processor seconds per change of load'
set logscale x
set format x '10^{%L}'
set mxtics 10
set xrange [9.45696e-05:13.82325]
set ylabel 'error'
set logscale y
set format y '10^{%L}'
set mytics 10
set yrange [3.1114353919999996e-06:1.018881269]
set autoscale noextend
set offsets 0, 0, 0, 0
set grid xtics ytics linecolor rgb '#d8d8d8' linewidth 0.7 linetype 1
set border linewidth 1.2
set errorbars 0.8
set key outside below center horizontal Left reverse samplen 2.5 height 0.8 spacing 1.1
set terminal svg size 800,562 font 'DejaVu Sans,15' background rgb 'white' enhanced
set output './packing.svg'
plot './packing.dat' index 0 using 1:2 with points linecolor rgb '#0072b2' pointtype 7 pointsize 0.7 linewidth 1.5 title 'md', \
     './packing.dat' index 1 using 1:2 with linespoints linecolor rgb '#d55e00' pointtype 5 pointsize 0.7 linewidth 1.5 title 'md, front', \
     './packing.dat' index 2 using 1:2 with points linecolor rgb '#009e73' pointtype 9 pointsize 0.7 linewidth 1.5 title 'cd', \
     './packing.dat' index 3 using 1:2 with linespoints linecolor rgb '#cc79a7' pointtype 13 pointsize 0.7 linewidth 1.5 title 'cd, front'
if (strstrt(GPVAL_TERMINALS, 'pngcairo') > 0) {
  set terminal pngcairo size 1600,1124 font 'DejaVu Sans,15' fontscale 2 linewidth 2 pointscale 2 enhanced
} else {
  set terminal png size 800,600 enhanced
}
set output './packing.png'
replot
set output
