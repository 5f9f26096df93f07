# gnuplot script; run it in its own folder: gnuplot 'regimes.gp'
set encoding utf8
set title 'States by solid fraction and rate'
set xlabel 'Phi'
set ylabel '{/:Italic I} / sqrt(kappa)'
set logscale y
set format y '10^{%L}'
set mytics 10
set yrange [1.6000000000000003e-05:0.039528470752104736]
set autoscale noextend
set offsets graph 0.03, graph 0.03, 0, 0
set grid xtics ytics linecolor rgb '#d8d8d8' linewidth 0.7 linetype 1
set border linewidth 1.2
set errorbars 0.8
set key outside below center horizontal Left reverse samplen 2.5 height 0.8 spacing 1.1
set terminal svg size 800,562 font 'DejaVu Sans,15' background rgb 'white' enhanced
set output './regimes.svg'
plot './regimes.dat' index 0 using 1:2 with points linecolor rgb '#0072b2' pointtype 7 pointsize 0.7 linewidth 1.5 title 'I = 0.01', \
     './regimes.dat' index 1 using 1:2 with points linecolor rgb '#d55e00' pointtype 5 pointsize 0.7 linewidth 1.5 title 'I = 0.03', \
     './regimes.dat' index 2 using 1:2 with points linecolor rgb '#009e73' pointtype 9 pointsize 0.7 linewidth 1.5 title 'I = 0.1', \
     './regimes.dat' index 3 using 1:2 with points linecolor rgb '#cc79a7' pointtype 13 pointsize 0.7 linewidth 1.5 title 'I = 0.2'
if (strstrt(GPVAL_TERMINALS, 'pngcairo') > 0) {
  set terminal pngcairo size 1600,1124 font 'DejaVu Sans,15' fontscale 2 linewidth 2 pointscale 2 enhanced
} else {
  set terminal png size 800,600 enhanced
}
set output './regimes.png'
replot
set output
