"""What is said of the files of scans, in Chinese: notes on how they were read, and why they were not."""

from __future__ import annotations

_NUMBER = r"[-+±]?[\d.]+"

FRAGMENTS: tuple[tuple[str, str], ...] = (
    (
        r"all its points lie at z < 0, as in OpenGL's axes \(x right, y up, z backward\)",
        "所有点的 z < 0,与 OpenGL 坐标轴一致(x 向右,y 向上,z 向后)",
    ),
    (r"the file does not tell how its axes run", "文件未说明坐标轴方向"),
    (r": the top of the picture was taken for ([-+]y) of the file", r":图像上方按文件的 \1 处理"),
    (r'; write axes = "(\w+)" where it is ([-+]y)', r';若应为 \2,请写 axes = "\1"'),
    (r"its depths look like distances from the camera: ", "深度值像是到相机的距离:"),
    (
        rf"as depths along the optical axis its largest face is a bowl, ({_NUMBER}) mm off a plane",
        r"按光轴深度计算,最大的面呈碗形,偏离平面 \1 mm",
    ),
    (rf", along the rays it is flat to ({_NUMBER}) mm", r",按射线距离则平整到 \1 mm"),
    (r"; export depths \(z\), or a point cloud", ";请导出深度(z)或点云"),
    (r"holds (\d+) pictures, of which number (\d+) was taken for the depth map", r"含 \1 幅图像,取第 \2 幅作为深度图"),
    (r"its pixels were taken as they are stored, to which the intrinsics belong", "像素按存储顺序读取,内参与之对应"),
    (r", and not turned as its orientation \((\d+)\) would show them", r",未按方向标记(\1)旋转"),
    (r"its first column counts its points and was left out", "第一列是点号,未采用"),
    (
        r"the rotation in its pose is 0 0 0 0, which is none: the pose was taken not to turn",
        "位姿中的旋转为 0 0 0 0,无效:按无旋转处理",
    ),
    (r"has distortion coefficients (\[[^\]]*\])", r"含畸变系数 \1"),
    (r", but points are computed for an undistorted camera: ", ",而点按无畸变相机计算:"),
    (
        r"export undistorted depth maps, or point clouds instead of depth maps",
        "请导出去畸变的深度图,或改用点云",
    ),
    (
        r"has (\d+) channels: it is a picture in colour, not a depth map, which has one",
        r"有 \1 个通道:是彩色图像,不是单通道深度图",
    ),
    (r"; colours show depths and do not hold them: ", ";颜色只是显示深度,并不保存深度:"),
    (
        r"save the depth map itself, as TIFF or 16-bit PNG, or the cloud as \.ply",
        "请保存深度图本身(TIFF 或 16 位 PNG),或将点云存为 .ply",
    ),
    (r"a depth map needs its intrinsics", "深度图需要内参"),
    (r"does not tell which of its columns are x, y and z", "看不出哪几列是 x、y、z"),
    (r"; call them x, y and z there", ";请在首行标明 x、y、z"),
)
"""Longer fragments stand before those that they contain."""
