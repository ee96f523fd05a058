"""What is said of live cameras: of their addresses, of frames that are lost, and of their settings."""

from __future__ import annotations

from aadm_workbench.model.sentences import Sentence

SENTENCES: dict[str, Sentence] = {
    "camera.all_played": Sentence("all {count:d} captures were played", "全部 {count:d} 次采集均已播放"),
    "camera.axes_system": Sentence(
        "the coordinates are {system}; set Scan3dCoordinateSystem to Cartesian",
        "坐标系为 {system}；请将 Scan3dCoordinateSystem 设为 Cartesian",
    ),
    "camera.busy": Sentence(
        "cannot be opened ({why}); does another program have it?", "无法打开（{why}）；是否被其他程序占用？"
    ),
    "camera.filled": Sentence(
        "holes are filled in the camera ({name} = {value}): what was not measured looks measured; set it to off",
        "相机中开启了孔洞填充（{name} = {value}）：未测量之处看似已测量；请关闭",
    ),
    "camera.frame_without": Sentence(
        "the frame holds no coordinates ({sent}); set the camera's pixel format to one of {formats}",
        "该帧不含坐标（{sent}）；请将相机的像素格式设为 {formats} 之一",
    ),
    "camera.gone": Sentence("the camera went away ({why})", "相机已断开（{why}）"),
    "camera.intrinsics_size": Sentence(
        "the frame has {width} x {height} pixels, the intrinsics of the camera are for {camera_width} x "
        "{camera_height}",
        "该帧为 {width} x {height} 像素，而相机内参对应 {camera_width} x {camera_height}",
    ),
    "camera.lens": Sentence(
        "the lens is not straightened (distortion {coefficients}), so depths alone are no points; set the pixel format "
        "to Coord3D_ABC32f, or let the camera straighten its pictures",
        "镜头畸变未校正（畸变系数 {coefficients}），仅有深度不能得到点；请将像素格式设为 "
        "Coord3D_ABC32f，或让相机校正其图像",
    ),
    "camera.library_not_loaded": Sentence(
        "cannot be loaded ({why}); take the .cti file for this system",
        "无法加载（{why}）；请使用适合本系统的 .cti 文件",
    ),
    "camera.mode": Sentence(
        "Scan3dOutputMode is {mode}, which is no distance; set it to {best}",
        "Scan3dOutputMode 为 {mode}，不是距离；请设为 {best}",
    ),
    "camera.no_camera": Sentence("is no camera; write {forms}", "不是相机地址；请写 {forms}"),
    "camera.no_capture": Sentence(
        "holds no capture: no folder with a scan in it, and no scan", "其中没有采集：既无含扫描的文件夹，也无扫描"
    ),
    "camera.no_folder": Sentence(
        "there is no such folder; write replay:FOLDER, with captures in it",
        "没有该文件夹；请写 replay:FOLDER，其中应有采集",
    ),
    "camera.no_frame": Sentence(
        "no frame came within {within_s:g} s; is it waiting for a trigger?",
        "{within_s:g} s 内没有收到帧；是否在等待触发？",
    ),
    "camera.no_ip": Sentence(
        "names no camera in the network; write {form}, such as {example}",
        "没有指明网络中的相机；请写 {form}，例如 {example}",
    ),
    "camera.no_producer": Sentence("is a library, but no GenTL producer", "是动态库，但不是 GenTL producer"),
    "camera.no_producer_file": Sentence(
        "there is no such file; name the .cti file that came with the camera's program",
        "没有该文件；请指定随相机软件提供的 .cti 文件",
    ),
    "camera.no_producer_named": Sentence(
        "names no producer; write gentl:FILE.cti, or gentl:FILE.cti#SERIAL",
        "没有指明 producer；请写 gentl:FILE.cti 或 gentl:FILE.cti#SERIAL",
    ),
    "camera.no_return": Sentence(
        "the frame holds no return at all: is the lens covered, or everything out of its range?",
        "该帧没有任何返回点：镜头是否被遮挡，或所有物体都在量程之外？",
    ),
    "camera.no_size": Sentence(
        "does not say how large a frame is (PayloadSize)", "相机没有给出一帧的大小（PayloadSize）"
    ),
    "camera.none_seen": Sentence(
        "the producer sees no camera; is it on, and in this network?", "producer 未发现相机；相机是否开机并在本网络中？"
    ),
    "camera.not_described": Sentence(
        "the camera does not describe its features ({why})", "相机没有给出其功能描述（{why}）"
    ),
    "camera.not_opened": Sentence(
        "cannot be opened ({why}); is it on and in this network, and does no other program have it?",
        "无法打开（{why}）；相机是否开机并在本网络中，且未被其他程序占用？",
    ),
    "camera.not_started": Sentence(
        "the camera does not start (AcquisitionStart); is it waiting for something else?",
        "相机无法启动采集（AcquisitionStart）；是否在等待其他条件？",
    ),
    "camera.not_there": Sentence(
        "no camera answers; is it on, and in this network?", "没有相机应答；相机是否开机并在本网络中？"
    ),
    "camera.not_there_among": Sentence("no such camera; there are {listed}", "没有该相机；现有 {listed}"),
    "camera.not_whole": Sentence(
        "the frame is not whole: its size is not the one that the camera said", "该帧不完整：其大小与相机所述不符"
    ),
    "camera.packets_lost": Sentence(
        "packets of the frame were lost, so it is not used; look at the cable, the switch and the size of packets",
        "该帧有数据包丢失，不予使用；请检查网线、交换机和数据包大小",
    ),
    "camera.producer_unstarted": Sentence(
        "the GenTL producer does not start ({why})", "GenTL producer 无法启动（{why}）"
    ),
    "camera.reference": Sentence(
        "the coordinates are in the system {reference}, not in the camera's own; set "
        "Scan3dCoordinateSystemReference to Anchor",
        "坐标属于 {reference} 坐标系，而不是相机自身的坐标系；请将 Scan3dCoordinateSystemReference 设为 Anchor",
    ),
    "camera.several": Sentence(
        "several cameras are there; name one of {listed}", "有多台相机；请指明其中一台：{listed}"
    ),
    "camera.short": Sentence(
        "the frame is not whole: {found:d} values of {format} where {width} x {height} pixels take {wanted:d}",
        "该帧不完整：{format} 有 {found:d} 个值，而 {width} x {height} 像素应有 {wanted:d} 个",
    ),
    "camera.sizes_differ": Sentence(
        "the coordinates of one frame come in different sizes ({sizes})", "同一帧的各坐标大小不同（{sizes}）"
    ),
    "camera.smoothed": Sentence(
        "smoothing is on in the camera ({name} = {value}): it moves the edges of sleeves; set it to off",
        "相机中开启了平滑（{name} = {value}）：会移动套筒边缘；请关闭",
    ),
    "camera.too_large": Sentence("is larger than any capture; it is left out", "大于任何采集；不予使用"),
    "camera.unit": Sentence(
        "the unit of the coordinates (Scan3dDistanceUnit) is {unit}; set it to Millimeter",
        "坐标单位（Scan3dDistanceUnit）为 {unit}；请设为 Millimeter",
    ),
    "camera.unit_unsaid": Sentence(
        "the unit of the coordinates (Scan3dDistanceUnit) is not said by the camera; set it to Millimeter",
        "相机没有给出坐标单位（Scan3dDistanceUnit）；请设为 Millimeter",
    ),
    "camera.unread": Sentence("cannot be read ({why}); this capture is left out", "无法读取（{why}）；该采集不予使用"),
    "camera.vendor_fault": Sentence("the camera's maker says: {why}", "相机厂商的程序报告：{why}"),
    "camera.vendor_ended": Sentence(
        "the program of the camera's maker ended in the middle, or said nothing for {within_s:g} s; it is started "
        "again",
        "相机厂商的程序中途结束，或 {within_s:g} s 内没有应答；将重新启动",
    ),
}
