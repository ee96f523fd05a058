"""What is said of scans, captures, cameras and depth maps."""

from __future__ import annotations

from aadm_workbench.model.sentences import Sentence

SENTENCES: dict[str, Sentence] = {
    "scan.axes": Sentence(
        "the axes of scans are {axes}; they must be one of {known}",
        "扫描的坐标轴为 {axes}；应为 {known} 之一",
    ),
    "scan.beside_rays": Sentence(
        "{name}: its points lie {offset_pixels:.1f} pixels beside the rays of their pixels; {remedy}",
        "{name}：点偏离其像素的视线 {offset_pixels:.1f} 像素；{remedy}",
    ),
    "scan.cameras_differ": Sentence(
        "describes cameras that differ, and none is called depth; keep the depth camera's only",
        "描述了多台不同的相机，且没有一台叫 depth；请只保留深度相机",
    ),
    "scan.capture_there": Sentence(
        "holds files already; name another folder for this capture",
        "其中已有文件；请为该采集指定另一个文件夹",
    ),
    "scan.capture_unwritten": Sentence(
        "the capture cannot be written ({why}); check that the folder around it is writable, and has room",
        "无法写入采集（{why}）；请检查其上级文件夹是否可写、是否有空间",
    ),
    "scan.centre": Sentence(
        "has its centre (cx, cy) = ({cx:.1f}, {cy:.1f}) outside of its {width} x {height} pixels: the size "
        "belongs to another camera or another resolution",
        "主点 (cx, cy) = ({cx:.1f}, {cy:.1f}) 在其 {width} x {height} 像素之外：该大小属于另一台相机或另一分辨率",
    ),
    "scan.channels": Sentence(
        "has {channels} channels: it is a picture, not a depth map, which has one",
        "有 {channels} 个通道：是图像，不是单通道深度图",
    ),
    "scan.colour": Sentence(
        "{name}: has {channels} channels: it is a picture in colour, not a depth map, which has one; colours show "
        "depths and do not hold them: save the depth map itself, as TIFF or 16-bit PNG, or the cloud as .ply",
        "{name}：有 {channels} "
        "个通道：是彩色图像，不是单通道深度图；颜色只是显示深度，并不保存深度：请保存深度图本身（TIFF 或 16 位 "
        "PNG），或将点云存为 .ply",
    ),
    "scan.depth_scale": Sentence(
        "depth_scale_mm is {depth_scale_mm}; it must be greater than 0, such as 0.02",
        "depth_scale_mm 为 {depth_scale_mm}；应大于 0，例如 0.02",
    ),
    "scan.depth_size": Sentence(
        "{name}: the depth map is {width} x {height} pixels, [camera] says {camera_width} x {camera_height}; "
        "write the intrinsics of the depth map (those of the texture camera may differ by a factor of 2)",
        "{name}：深度图为 {width} x {height} 像素，而 [camera] 为 {camera_width} x "
        "{camera_height}；请填写深度图的内参（纹理相机的内参可能相差一倍）",
    ),
    "scan.depth_step": Sentence(
        "{name}: an integer depth map needs its step; add depth_scale_mm to [camera]",
        "{name}：整数深度图需要步长；请在 [camera] 中加入 depth_scale_mm",
    ),
    "scan.depth_type": Sentence(
        "has pixels of type {dtype}; a depth map is uint16, float32 or float64",
        "像素类型为 {dtype}；深度图应为 uint16、float32 或 float64",
    ),
    "scan.distorted": Sentence(
        "has distortion coefficients {distortion}, but points are computed for an undistorted camera: export "
        "undistorted depth maps, or point clouds instead of depth maps",
        "含畸变系数 {distortion}，而点按无畸变相机计算：请导出去畸变的深度图，或改用点云",
    ),
    "scan.eight_bits": Sentence(
        "has 8 bits a pixel: it is a picture or a preview; export the depth map itself",
        "每像素 8 位：是图片或预览；请导出深度图本身",
    ),
    "scan.few_points": Sentence(
        "{name}: has {count} points, {needed} are the least to measure on; scan it again",
        "{name}：只有 {count} 个点，测量至少需要 {needed} 个；请重新扫描",
    ),
    "scan.focal": Sentence(
        "has focal lengths fx = {fx}, fy = {fy}, which cannot be; they are in pixels",
        "焦距为 fx = {fx}、fy = {fy}，这不可能；单位应为像素",
    ),
    "scan.folder_empty": Sentence(
        "{name}: is a folder without a scan in it; name the folder of a capture, with a depth map (such as "
        "depth.tiff) or a point cloud, or name one file",
        "{name}：文件夹中没有扫描；请指定采集的文件夹，其中应有深度图（如 depth.tiff）或点云，或指定一个文件",
    ),
    "scan.folder_full": Sentence(
        "{name}: holds more than {most} files; name the folder of one capture, or one file",
        "{name}：文件多于 {most} 个；请指定单次采集的文件夹，或指定一个文件",
    ),
    "scan.folder_unreadable": Sentence(
        "the folder cannot be read ({why}); check its permissions",
        "无法读取该文件夹（{why}）；请检查权限",
    ),
    "scan.format": Sentence(
        "{path}: files of type {suffix} are not read; export one of {known}",
        "{path}：不支持 {suffix} 类型的文件；请导出为 {known} 之一",
    ),
    "scan.grey_size": Sentence(
        "is {width} x {height} pixels, its scan {scan_width} x {scan_height}; name the picture of the depth "
        "camera, or leave it out",
        "为 {width} x {height} 像素，而其扫描为 {scan_width} x {scan_height}；请指定深度相机的图像，或不指定",
    ),
    "scan.header_breaks": Sentence(
        "ends or breaks off within its header ({size_bytes} bytes); copy it again",
        "文件在文件头中断（{size_bytes} 字节）；请重新拷贝",
    ),
    "scan.intrinsics_deep": Sentence("is nested deeper than any file of intrinsics", "嵌套深度超出任何内参文件"),
    "scan.intrinsics_differ": Sentence(
        "{first} and {second} in one folder hold different intrinsics; call those of the depth map depth..., or "
        "keep them alone",
        "同一文件夹中 {first} 与 {second} 的内参不同；请将深度图的内参命名为 depth...，或只保留它",
    ),
    "scan.intrinsics_from": Sentence("intrinsics from {name}", "内参取自 {name}"),
    "scan.intrinsics_invalid": Sentence("is no valid {kind}: {why}", "不是有效的 {kind}：{why}"),
    "scan.intrinsics_not_job": Sentence(
        "{name} beside the scan holds other intrinsics than [camera] of the job; keep the right ones",
        "扫描旁的 {name} 与任务的 [camera] 内参不同；请保留正确的一份",
    ),
    "scan.is_device": Sentence("is a device or a pipe; name a scan file", "是设备或管道；请指定扫描文件"),
    "scan.is_empty": Sentence(
        "is empty (0 bytes); the export or the copy did not finish, export it again",
        "是空文件（0 字节）；导出或拷贝未完成，请重新导出",
    ),
    "scan.is_folder": Sentence("is a folder; name one file in it", "是文件夹；请指定其中一个文件"),
    "scan.joined": Sentence(
        "holds {count} scans, which were joined by the poses that they carry",
        "含 {count} 个扫描，已按各自的位姿合并",
    ),
    "scan.metres": Sentence(
        'it looks like metres declared as mm: write units = "m" in the job, or for a 16-bit depth map the right '
        "depth_scale_mm",
        '像是把米声明为 mm：请在任务中写 units = "m"，或为 16 位深度图写正确的 depth_scale_mm',
    ),
    "scan.metres_or_inches": Sentence(
        'it looks like metres or inches declared as mm: write units = "m" in the job, or convert the inches',
        '像是把米或英寸声明为 mm：请在任务中写 units = "m"，或将英寸换算',
    ),
    "scan.millimetres": Sentence(
        'it looks like mm declared as metres: write units = "mm" in the job',
        '像是把 mm 声明为米：请在任务中写 units = "mm"',
    ),
    "scan.most_pixels": Sentence(
        "has {width} x {height} pixels, more than any camera",
        "为 {width} x {height} 像素，超出任何相机",
    ),
    "scan.needs_intrinsics": Sentence(
        "{name}: a depth map needs its intrinsics; add [camera] with {wanted} to the job",
        "{name}：深度图需要内参；请在任务中加入 [camera]，含 {wanted}",
    ),
    "scan.no_file": Sentence(
        "there is no such file; check its name, upper and lower case included, and its folder",
        "没有该文件；请检查文件名（含大小写）及所在文件夹",
    ),
    "scan.no_fx": Sentence(
        "holds no fx, fy, cx and cy that belong together; write them as fx = ..., fy = ..., ...",
        "没有成组的 fx、fy、cx 和 cy；请写成 fx = ...、fy = ...、...",
    ),
    "scan.no_intrinsics_size": Sentence(
        "{path}: has {size_bytes} bytes, which is no file of intrinsics; name the right one",
        "{path}：有 {size_bytes} 字节，不是内参文件；请指定正确的文件",
    ),
    "scan.no_number": Sentence("has {key} = {value}, which is no number", "{key} = {value} 不是数"),
    "scan.no_picture": Sentence(
        "cannot be decoded: it is no picture, damaged or cut off; copy or export it again",
        "无法解码：不是图像，或已损坏、不完整；请重新拷贝或导出",
    ),
    "scan.no_size": Sentence(
        "does not say how large the depth map is; add a line such as: width: 1920, height: 1200",
        "未说明深度图的大小；请加一行，例如：width: 1920, height: 1200",
    ),
    "scan.no_unit": Sentence(
        "no unit explains that: check that the scan shows this component, and crop what does not belong to it",
        "没有单位能解释：请确认扫描的是该构件，并裁去不属于它的部分",
    ),
    "scan.no_whole": Sentence(
        "has {key} = {value}; it must be a whole number of pixels",
        "{key} = {value}；应为整数像素",
    ),
    "scan.no_xml": Sentence("is no valid XML: {why}", "不是有效的 XML：{why}"),
    "scan.not_depth_picture": Sentence(
        "is neither a TIFF nor a PNG; a depth map is one of the two, check its extension",
        "既不是 TIFF 也不是 PNG，深度图应为二者之一；请检查扩展名",
    ),
    "scan.not_intrinsics": Sentence(
        "{name} was not understood as intrinsics: it {why}",
        "{name} 未能识别为内参：{why}",
    ),
    "scan.not_opengl": Sentence(
        'its points lie at z > 0, before a camera that looks along z, but axes = "opengl" says that z runs '
        'backward; write axes = "camera"',
        '所有点的 z > 0，即在沿 z 看的相机前方，但 axes = "opengl" 表示 z 向后；请写 axes = "camera"',
    ),
    "scan.nothing_measured": Sentence(
        "none of its {count} points is a measurement; scan again, or export the right frame",
        "其 {count} 个点无一有效；请重新扫描，或导出正确的帧",
    ),
    "scan.opengl_axes": Sentence(
        "all its points lie at z < 0, as in OpenGL's axes (x right, y up, z backward): the top of the picture was "
        'taken for +y of the file; write axes = "camera" where it is -y',
        "所有点的 z < 0，与 OpenGL 坐标轴一致（x 向右，y 向上，z 向后）：图像上方按文件的 +y 处理；若应为 "
        '-y，请写 axes = "camera"',
    ),
    "scan.orientation": Sentence(
        "its pixels were taken as they are stored, to which the intrinsics belong, and not turned as its "
        "orientation ({orientation}) would show them",
        "像素按存储顺序读取（内参与之对应），未按方向标记（{orientation}）旋转",
    ),
    "scan.other_camera": Sentence(
        "either [camera] holds the intrinsics of another camera, or the cloud is not in the camera's frame: then "
        "check it in a job without [camera]",
        "可能 [camera] 是另一台相机的内参，或点云不在相机坐标系中：后者请在没有 [camera] 的任务中检查",
    ),
    "scan.out_of_camera": Sentence(
        "{name}: only {fraction:.0%} of its points lie in the view of [camera]; {remedy}",
        "{name}：只有 {fraction:.0%} 的点在 [camera] 的视野内；{remedy}",
    ),
    "scan.pages": Sentence(
        "holds {count} pictures, of which number {number} was taken for the depth map",
        "含 {count} 幅图像，取第 {number} 幅作为深度图",
    ),
    "scan.picture_kind": Sentence(
        "is no picture that is read here; save it as PNG, TIFF, JPEG or BMP",
        "不是可读的图像；请存为 PNG、TIFF、JPEG 或 BMP",
    ),
    "scan.picture_large": Sentence(
        "announces {width} x {height} pixels, more than any camera has; export it again",
        "声明为 {width} x {height} 像素，超出任何相机；请重新导出",
    ),
    "scan.png_ends": Sentence(
        "ends at byte {size_bytes}, before its last chunk: it is cut off; copy it again",
        "在第 {size_bytes} 字节处、最后一个数据块之前结束：文件不完整；请重新拷贝",
    ),
    "scan.ray_distances": Sentence(
        "{name}: its depths look like distances from the camera: as depths along the optical axis its largest "
        "face is a bowl, {bowl_mm:.1f} mm off a plane, along the rays it is flat to {flat_mm:.2f} mm; export "
        "depths (z), or a point cloud",
        "{name}：深度值像是到相机的距离：按光轴深度计算，最大的面呈碗形，偏离平面 {bowl_mm:.1f} "
        "mm，按射线距离则平整到 {flat_mm:.2f} mm；请导出深度（z）或点云",
    ),
    "scan.several_scans": Sentence(
        "{name}: holds several scans ({listed}); name the one that is meant",
        "{name}：有多个扫描（{listed}）；请指定其中一个",
    ),
    "scan.size_differs": Sentence(
        "{name}: the cloud is {cloud_width} x {cloud_height} pixels, [camera] says {width} x {height}; write the "
        "intrinsics that belong to the scan",
        "{name}：点云为 {cloud_width} x {cloud_height} 像素，而 [camera] 为 {width} x {height}；请填写该扫描的内参",
    ),
    "scan.span": Sentence(
        "{name}: its points span {sizes} mm, but the pattern to be found in it spans {expected_mm:.4g} mm; {remedy}",
        "{name}：点的范围为 {sizes} mm，而要在其中找到的布置为 {expected_mm:.4g} mm；{remedy}",
    ),
    "scan.stray": Sentence(
        "{count} points more than {reach_m:.0f} m away from the others were left out",
        "有 {count} 个点距其他点超过 {reach_m:.0f} m，未采用",
    ),
    "scan.taken_since": Sentence("{name} was taken: {why}", "采用了 {name}：{why}"),
    "scan.taken_without": Sentence(
        "{name} was taken: {scan} has no intrinsics beside it",
        "采用了 {name}：{scan} 旁没有内参",
    ),
    "scan.texture_left_out": Sentence(
        "{name} is left out: it is not of the size of the depth map",
        "{name} 未采用：与深度图大小不同",
    ),
    "scan.too_large": Sentence(
        "has {size_bytes} bytes, more than {limit_gb:.0f} GiB; crop the scan to the component",
        "有 {size_bytes} 字节，超过 {limit_gb:.0f} GiB；请将扫描裁剪到构件范围",
    ),
    "scan.unit_of_file": Sentence(
        "the unit of the file was taken, {mm_per_unit:.7g} mm: {why}",
        "采用文件的单位 {mm_per_unit:.7g} mm：{why}",
    ),
    "scan.unit_of_job": Sentence(
        "the unit that the job declares was taken: with the one that the file gives the scan cannot show its pattern",
        "采用任务声明的单位：按文件给出的单位，扫描不可能显示其布置",
    ),
    "scan.units": Sentence(
        "the unit of scans is {units}; it must be one of {known}",
        "扫描的单位为 {units}；应为 {known} 之一",
    ),
    "scan.unreadable": Sentence(
        "cannot be read ({why}); check the permissions and the disk it is on",
        "无法读取（{why}）；请检查权限和所在磁盘",
    ),
    "scan.wanted_intrinsics": Sentence(
        "fx, fy, cx, cy, width = {width} and height = {height}",
        "fx、fy、cx、cy、width = {width} 和 height = {height}",
    ),
    "scan.which_page": Sentence(
        "holds {count} pictures ({kinds}), and none or several may be the depth map; save it alone",
        "含 {count} 幅图像（{kinds}），没有或有多幅可能是深度图；请单独保存深度图",
    ),
    "scan.write_depth": Sentence(
        "{path}: a depth of {deepest_mm:.0f} mm does not fit into 65535 steps of {depth_scale_mm} mm; take a "
        "depth_scale_mm of {least_mm:.4g} or more",
        "{path}：{deepest_mm:.0f} mm 的深度超出 65535 个 {depth_scale_mm} mm 的步长；请取 depth_scale_mm 为 "
        "{least_mm:.4g} 或更大",
    ),
    "scan.write_mode": Sentence(
        "mode {mode} of a PCD file is not one of {known}",
        "PCD 文件的模式 {mode} 不在 {known} 之中",
    ),
    "scan.write_shape": Sentence(
        "points of shape {shape} are neither (n, 3) nor (h, w, 3)",
        "形状为 {shape} 的点既不是 (n, 3) 也不是 (h, w, 3)",
    ),
    "scan.xml_deep": Sentence(
        "is XML nested more than {most} deep, which no camera writes",
        "XML 嵌套超过 {most} 层，没有相机这样写",
    ),
    "scan.xml_doctype": Sentence(
        "declares its own XML document type, which no camera writes: it may be meant to harm",
        "声明了自己的 XML 文档类型，没有相机这样写：可能有恶意",
    ),
}
