# gnuplot docs/images/reference-error.gp, from the repository's root: the table of docs/measured.md as a picture.
set terminal svg size 640,400 font "sans-serif,13" background "#fffefb"
set output "docs/images/reference-error.svg"
$error << TABLE
16   0.05982 0.01806
32   0.03818 0.01270
64   0.02199 0.00798
128  0.01142 0.00498
256  0.00735 0.00339
512  0.00470 0.00239
1024 0.00299 0.00163
TABLE
set logscale xy
set xlabel "samples N"
set ylabel "RMSE"
set xtics (16, 32, 64, 128, 256, 512, 1024)
set ytics (0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1)
set yrange [0.001:0.1]
set grid linecolor "#dddddd"
set key top right
plot $error using 1:2 with linespoints linewidth 2 pointtype 7 linecolor "#1f6f8b" title "radiance", \
     $error using 1:3 with linespoints linewidth 2 pointtype 5 linecolor "#b5500b" title "cut at 1, as displays do", \
     0.05982 * (x / 16.0)**-0.65 dashtype 2 linecolor "#888888" title "N^{-0.65}", \
     0.05982 * (x / 16.0)**-0.5 dashtype 3 linecolor "#888888" title "N^{-0.5}, noise"
