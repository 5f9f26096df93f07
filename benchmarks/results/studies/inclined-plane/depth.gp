# gnuplot script; run it in its own folder: gnuplot 'depth.gp'
set encoding utf8
set title 'Inertial number through a layer that flows down a slope (quick size)'
set xlabel 'height above the floor / d'
set ylabel 'inertial number {/:Italic I}'
set autoscale noextend
set offsets graph 0.03, graph 0.03, graph 0.03, graph 0.03
set grid xtics ytics linecolor rgb '#d8d8d8' linewidth 0.7 linetype 1
set border linewidth 1.2
set errorbars 0.8
set key outside below center horizontal Left reverse samplen 2.5 height 0.8 spacing 1.1
set terminal svg size 800,584 font 'DejaVu Sans,15' background rgb 'white' enhanced
set output './depth.svg'
plot './depth.dat' index 0 using 1:2 with linespoints linecolor rgb '#0072b2' pointtype 7 pointsize 0.7 linewidth 1.5 title 'md, 18 degrees', \
     './depth.dat' index 1 using 1:2 with linespoints linecolor rgb '#d55e00' pointtype 5 pointsize 0.7 linewidth 1.5 title 'md, 20 degrees', \
     './depth.dat' index 2 using 1:2 with linespoints linecolor rgb '#009e73' pointtype 9 pointsize 0.7 linewidth 1.5 title 'md, 22 degrees', \
     './depth.dat' index 3 using 1:2 with linespoints linecolor rgb '#cc79a7' pointtype 13 pointsize 0.7 linewidth 1.5 title 'cd, 18 degrees', \
     './depth.dat' index 4 using 1:2 with linespoints linecolor rgb '#e69f00' pointtype 11 pointsize 0.7 linewidth 1.5 title 'cd, 20 degrees', \
     './depth.dat' index 5 using 1:2 with linespoints linecolor rgb '#56b4e9' pointtype 15 pointsize 0.7 linewidth 1.5 title 'cd, 22 degrees'
if (strstrt(GPVAL_TERMINALS, 'pngcairo') > 0) {
  set terminal pngcairo size 1600,1168 font 'DejaVu Sans,15' fontscale 2 linewidth 2 pointscale 2 enhanced
} else {
  set terminal png size 800,600 enhanced
}
set output './depth.png'
replot
set output
