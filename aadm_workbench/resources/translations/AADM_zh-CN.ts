<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="zh_CN" sourcelanguage="en">
 <context>
  <name>AADM</name>
  <message>
   <source>AADM checks</source>
   <translation>AADM 检测</translation>
  </message>
  <message>
   <source>AADM report</source>
   <translation>AADM 报告</translation>
  </message>
  <message>
   <source>Another panel is open in the task view: close it first.</source>
   <translation>任务面板中已打开另一个面板：请先关闭它。</translation>
  </message>
  <message>
   <source>Cancel</source>
   <translation>取消</translation>
  </message>
  <message>
   <source>Checks precast columns against their connecting rebars before they are hoisted</source>
   <translation>在吊装前检测预制柱灌浆套筒与连接钢筋是否对位</translation>
  </message>
  <message>
   <source>Choose</source>
   <translation>选择</translation>
  </message>
  <message>
   <source>Choose a folder: a capture as the camera saves it</source>
   <translation>选择文件夹：相机保存的一次采集</translation>
  </message>
  <message>
   <source>Close</source>
   <translation>关闭</translation>
  </message>
  <message>
   <source>Install now</source>
   <translation>立即安装</translation>
  </message>
  <message>
   <source>No document is open: open the model first.</source>
   <translation>没有打开的文档：请先打开模型。</translation>
  </message>
  <message>
   <source>Select an AADM column, or the object of the model that it belongs to.</source>
   <translation>请选择一个 AADM 柱，或其对应的模型对象。</translation>
  </message>
  <message>
   <source>Several columns are selected: select one.</source>
   <translation>选中了多根柱：请只选一根。</translation>
  </message>
  <message>
   <source>The process that checks ended with {code} and said nothing; repair its environment</source>
   <translation>检测进程以 {code} 结束，没有给出任何说明；请修复其运行环境</translation>
  </message>
  <message>
   <source>The top of the set column is not predicted: see the report</source>
   <translation>未预测就位后的柱顶：见报告</translation>
  </message>
  <message>
   <source>There is not enough memory for this scan: crop it to the component, or close others.</source>
   <translation>内存不足以处理此扫描：请裁剪到构件范围，或关闭其他文件。</translation>
  </message>
  <message>
   <source>This document has no AADM column yet: select a column of the model, then Sample design.</source>
   <translation>此文档还没有 AADM 柱：请选择模型中的柱，然后“提取设计点”。</translation>
  </message>
  <message>
   <source>This needs packages that FreeCAD does not bring. AADM installs them into a folder of their own, once; FreeCAD itself is not changed.</source>
   <translation>此操作需要 FreeCAD 不带的软件包。AADM 只需一次把它们安装到单独的文件夹里；FreeCAD 本身不作任何改动。</translation>
  </message>
  <message>
   <source>This should not happen ({kind}: {reason}). The log of the report view shows where.</source>
   <translation>出现了意外情况（{kind}：{reason}）。详见报告浏览器中的日志。</translation>
  </message>
  <message>
   <source>Top of the set column: {top} – {verdict}</source>
   <translation>就位后柱顶：{top} – {verdict}</translation>
  </message>
  <message>
   <source>against its own bars alone</source>
   <translation>只相对于本柱钢筋</translation>
  </message>
  <message>
   <source>against the grid</source>
   <translation>相对于轴网</translation>
  </message>
  <message>
   <source>against the grid, through the column below</source>
   <translation>相对于轴网（经下层柱传递）</translation>
  </message>
  <message>
   <source>arrows ×{factor:g}</source>
   <translation>箭头放大 ×{factor:g}</translation>
  </message>
  <message>
   <source>cancelled</source>
   <translation>已取消</translation>
  </message>
  <message>
   <source>cancelling…</source>
   <translation>正在取消…</translation>
  </message>
  <message>
   <source>error</source>
   <translation>出错</translation>
  </message>
  <message>
   <source>fail</source>
   <translation>不合格</translation>
  </message>
  <message>
   <source>inconclusive</source>
   <translation>不确定</translation>
  </message>
  <message>
   <source>not assessed</source>
   <translation>未评定</translation>
  </message>
  <message>
   <source>not checked</source>
   <translation>未检测</translation>
  </message>
  <message>
   <source>not measured</source>
   <translation>未测得</translation>
  </message>
  <message>
   <source>pass</source>
   <translation>合格</translation>
  </message>
  <message>
   <source>{column} (copy)</source>
   <translation>{column}（副本）</translation>
  </message>
  <message>
   <source>{count} columns of {file} are shown</source>
   <translation>已显示 {file} 中的 {count} 根柱</translation>
  </message>
  <message>
   <source>{document} has {count} AADM columns, and a scan belongs to one: use Import scan with that column selected</source>
   <translation>{document} 有 {count} 根 AADM 柱，而一个扫描只属于一根柱：请选中该柱后使用“导入扫描”</translation>
  </message>
  <message>
   <source>{file} was added to {column}</source>
   <translation>{file} 已添加到 {column}</translation>
  </message>
  <message>
   <source>{file}: a job is checked in the window, or by: aadm check</source>
   <translation>{file}：任务在窗口中检测，或用命令 aadm check</translation>
  </message>
  <message>
   <source>{label} cannot be drawn ({reason}); check its column again</source>
   <translation>无法绘制 {label}（{reason}）；请重新检测该柱</translation>
  </message>
  <message>
   <source>{label} was saved by a newer version of the AADM workbench: update it before changing this object</source>
   <translation>{label} 由更新版本的 AADM 工作台保存：请先升级再修改此对象</translation>
  </message>
  <message>
   <source>{off} ± {u}, {against}</source>
   <translation>{off} ± {u}，{against}</translation>
  </message>
  <message>
   <source>{program} cannot be run; look at the settings</source>
   <translation>无法运行 {program}；请检查设置</translation>
  </message>
  <message>
   <source>→ {pose} in the job: the top comes to {after}</source>
   <translation>→ 在任务中写 {pose}：柱顶偏差变为 {after}</translation>
  </message>
 </context>
 <context>
  <name>AADM_About</name>
  <message>
   <source>About AADM</source>
   <translation>关于 AADM</translation>
  </message>
  <message>
   <source>About AADM and doctor</source>
   <translation>关于 AADM 与环境诊断</translation>
  </message>
  <message>
   <source>Checks precast columns against their connecting rebars.</source>
   <translation>检测预制柱灌浆套筒与连接钢筋的对位。</translation>
  </message>
  <message>
   <source>Checks run with {program}.</source>
   <translation>检测由 {program} 执行。</translation>
  </message>
  <message>
   <source>Installed, in a folder of its own; FreeCAD itself is not changed.</source>
   <translation>已安装在单独的文件夹中；FreeCAD 本身没有改动。</translation>
  </message>
  <message>
   <source>Shows the version, tries the workbench on a sample, installs or repairs what it needs</source>
   <translation>显示版本，用样例试用工作台，安装或修复它所需的软件包</translation>
  </message>
  <message>
   <source>Try it on a sample floor</source>
   <translation>用样例楼层试用</translation>
  </message>
  <message>
   <source>What it runs with</source>
   <translation>运行环境</translation>
  </message>
 </context>
 <context>
  <name>AADM_Camera</name>
  <message>
   <source>A plate with holes like sleeves and pins like bars, for a workshop to make.</source>
   <translation>一块带有套筒状孔和钢筋状销的标定板，交由车间加工。</translation>
  </message>
  <message>
   <source>Camera profile</source>
   <translation>相机档案</translation>
  </message>
  <message>
   <source>Camera profile…</source>
   <translation>相机档案…</translation>
  </message>
  <message>
   <source>Capture</source>
   <translation>采集</translation>
  </message>
  <message>
   <source>Captures</source>
   <translation>采集</translation>
  </message>
  <message>
   <source>Captures of the plate</source>
   <translation>标定板的采集</translation>
  </message>
  <message>
   <source>Checks use no profile of a camera.</source>
   <translation>检查不使用相机档案。</translation>
  </message>
  <message>
   <source>Checks use {file}</source>
   <translation>检查使用 {file}</translation>
  </message>
  <message>
   <source>Choose captures…</source>
   <translation>选择采集…</translation>
  </message>
  <message>
   <source>Choose the capture of the plate.</source>
   <translation>请选择标定板的采集。</translation>
  </message>
  <message>
   <source>Choose the captures of the plate.</source>
   <translation>请选择标定板的各次采集。</translation>
  </message>
  <message>
   <source>Choose the file that the profile is written to.</source>
   <translation>请选择相机档案要写入的文件。</translation>
  </message>
  <message>
   <source>Choose the folder to write into.</source>
   <translation>请选择要写入的文件夹。</translation>
  </message>
  <message>
   <source>Choose the plate.toml of the plate, on the page Learn.</source>
   <translation>请在“学习”页选择标定板的 plate.toml。</translation>
  </message>
  <message>
   <source>Choose the plate.toml of the plate.</source>
   <translation>请选择标定板的 plate.toml。</translation>
  </message>
  <message>
   <source>Choose the profile of the camera.</source>
   <translation>请选择相机档案。</translation>
  </message>
  <message>
   <source>Date</source>
   <translation>日期</translation>
  </message>
  <message>
   <source>Depth step</source>
   <translation>深度步长</translation>
  </message>
  <message>
   <source>Draw the plate</source>
   <translation>绘制标定板</translation>
  </message>
  <message>
   <source>Draws a plate for a workshop, learns a camera from captures of it, verifies it before a shift</source>
   <translation>绘制供车间加工的标定板，由其采集学习相机，并在班前核验</translation>
  </message>
  <message>
   <source>Folder</source>
   <translation>文件夹</translation>
  </message>
  <message>
   <source>Holes</source>
   <translation>孔数</translation>
  </message>
  <message>
   <source>Intrinsics</source>
   <translation>内参</translation>
  </message>
  <message>
   <source>Learn</source>
   <translation>学习</translation>
  </message>
  <message>
   <source>Learn the camera</source>
   <translation>学习相机</translation>
  </message>
  <message>
   <source>One capture before the shift. Plate, intrinsics and date are those of Learn.</source>
   <translation>班前采集一次。标定板、内参和日期取自“学习”页。</translation>
  </message>
  <message>
   <source>Pins, diameter</source>
   <translation>销直径</translation>
  </message>
  <message>
   <source>Pitch</source>
   <translation>间距</translation>
  </message>
  <message>
   <source>Plate</source>
   <translation>标定板</translation>
  </message>
  <message>
   <source>Profile</source>
   <translation>档案</translation>
  </message>
  <message>
   <source>Profile to write</source>
   <translation>要写入的档案</translation>
  </message>
  <message>
   <source>Serial number</source>
   <translation>序列号</translation>
  </message>
  <message>
   <source>Settings</source>
   <translation>设置</translation>
  </message>
  <message>
   <source>Six to twelve captures of the whole plate: two distances, tilted up to 5°, turned by quarter turns.</source>
   <translation>采集整块标定板六至十二次：两种距离，倾斜不超过 5°，依次转动四分之一圈。</translation>
  </message>
  <message>
   <source>Their diameter</source>
   <translation>孔径</translation>
  </message>
  <message>
   <source>Use no profile</source>
   <translation>不使用档案</translation>
  </message>
  <message>
   <source>Verify</source>
   <translation>核验</translation>
  </message>
  <message>
   <source>Verify the camera</source>
   <translation>核验相机</translation>
  </message>
  <message>
   <source>Written: {folder}</source>
   <translation>已写入：{folder}</translation>
  </message>
  <message>
   <source>not given</source>
   <translation>未给出</translation>
  </message>
  <message>
   <source>of bars</source>
   <translation>钢筋的伸缩</translation>
  </message>
  <message>
   <source>plate.pdf, plate.dxf, plate.step and plate.toml are in</source>
   <translation>plate.pdf、plate.dxf、plate.step 和 plate.toml 位于</translation>
  </message>
  <message>
   <source>scale</source>
   <translation>比例</translation>
  </message>
  <message>
   <source>stretch of sleeves</source>
   <translation>套筒的伸缩</translation>
  </message>
  <message>
   <source>{count} captures, from {near:.0f} to {far:.0f} mm</source>
   <translation>{count} 次采集，距离 {near:.0f} 至 {far:.0f} mm</translation>
  </message>
 </context>
 <context>
  <name>AADM_Capture</name>
  <message>
   <source>Capture</source>
   <translation>采集</translation>
  </message>
  <message>
   <source>Choose the folder that captures are kept in: they are the record.</source>
   <translation>请选择保存采集的文件夹：采集即原始记录。</translation>
  </message>
  <message>
   <source>Folder of the captures</source>
   <translation>采集文件夹</translation>
  </message>
  <message>
   <source>Kept in</source>
   <translation>保存于</translation>
  </message>
  <message>
   <source>Name a camera: {forms}.</source>
   <translation>请指定相机：{forms}。</translation>
  </message>
 </context>
 <context>
  <name>AADM_CaptureScan</name>
  <message>
   <source>Capture…</source>
   <translation>采集…</translation>
  </message>
  <message>
   <source>Takes a scan with a live camera and gives it to the selected column</source>
   <translation>用在线相机采集扫描并交给所选柱</translation>
  </message>
 </context>
 <context>
  <name>AADM_Check</name>
  <message>
   <source>Against the design</source>
   <translation>与设计比较</translation>
  </message>
  <message>
   <source>Camera profile</source>
   <translation>相机档案</translation>
  </message>
  <message>
   <source>Check</source>
   <translation>检测</translation>
  </message>
  <message>
   <source>Check column</source>
   <translation>检测柱</translation>
  </message>
  <message>
   <source>Check {column}</source>
   <translation>检测 {column}</translation>
  </message>
  <message>
   <source>Decision</source>
   <translation>判定规则</translation>
  </message>
  <message>
   <source>Method</source>
   <translation>方法</translation>
  </message>
  <message>
   <source>Not checked yet</source>
   <translation>尚未检测</translation>
  </message>
  <message>
   <source>Only what fails</source>
   <translation>只看不合格项</translation>
  </message>
  <message>
   <source>Reads the points of its scans into the view</source>
   <translation>将扫描的点读入视图</translation>
  </message>
  <message>
   <source>Scans</source>
   <translation>扫描</translation>
  </message>
  <message>
   <source>Settings of the check</source>
   <translation>检测设置</translation>
  </message>
  <message>
   <source>Show its scans</source>
   <translation>显示扫描</translation>
  </message>
  <message>
   <source>Tolerances</source>
   <translation>允许偏差</translation>
  </message>
  <message>
   <source>Trial assembly, best position (minimax)</source>
   <translation>试装，最佳位置（最小最大）</translation>
  </message>
  <message>
   <source>Trial assembly, least squares</source>
   <translation>试装，最小二乘</translation>
  </message>
  <message>
   <source>none yet: Import scan</source>
   <translation>还没有：请导入扫描</translation>
  </message>
  <message>
   <source>{verdict} · goes on: {goes_on}</source>
   <translation>{verdict} · 能否就位：{goes_on}</translation>
  </message>
  <message>
   <source>… and {count} more, see the table</source>
   <translation>……另有 {count} 项，见表</translation>
  </message>
 </context>
 <context>
  <name>AADM_CheckAll</name>
  <message>
   <source>A column is not there any more: open this panel again.</source>
   <translation>有一根柱已不存在：请重新打开此面板。</translation>
  </message>
  <message>
   <source>A scan is found where its name holds that of its column, and sleeves or bars, such as {id}-foot.ply. Others: double-click their place in the table.</source>
   <translation>扫描文件名中含柱名，并含套筒或钢筋字样时（如 {id}-foot.ply）会自动找到；其余请在表中双击相应位置选择。</translation>
  </message>
  <message>
   <source>Camera</source>
   <translation>相机</translation>
  </message>
  <message>
   <source>Check all</source>
   <translation>全部检测</translation>
  </message>
  <message>
   <source>Check all…</source>
   <translation>全部检测…</translation>
  </message>
  <message>
   <source>Choose the folder that holds the scans.</source>
   <translation>请选择存放扫描的文件夹。</translation>
  </message>
  <message>
   <source>Choose where the job file is written.</source>
   <translation>请选择任务文件的保存位置。</translation>
  </message>
  <message>
   <source>Column</source>
   <translation>柱</translation>
  </message>
  <message>
   <source>Double-click to choose its scan</source>
   <translation>双击选择扫描</translation>
  </message>
  <message>
   <source>Finds the scans of all columns in a folder, or of several that are selected, and checks them at once</source>
   <translation>在文件夹中查找所有柱（或所选若干柱）的扫描，并一次检测</translation>
  </message>
  <message>
   <source>Folder of scans</source>
   <translation>扫描文件夹</translation>
  </message>
  <message>
   <source>Intrinsics</source>
   <translation>内参</translation>
  </message>
  <message>
   <source>Job</source>
   <translation>任务</translation>
  </message>
  <message>
   <source>Job file</source>
   <translation>任务文件</translation>
  </message>
  <message>
   <source>No column that is switched on has scans: choose their folder first.</source>
   <translation>勾选的柱都没有扫描：请先选择扫描文件夹。</translation>
  </message>
  <message>
   <source>Rebars</source>
   <translation>钢筋</translation>
  </message>
  <message>
   <source>Scans</source>
   <translation>扫描</translation>
  </message>
  <message>
   <source>Scans are found by the names of columns in their names</source>
   <translation>按文件名中的柱号查找扫描</translation>
  </message>
  <message>
   <source>Scans of columns</source>
   <translation>各柱的扫描</translation>
  </message>
  <message>
   <source>Scans of {column}</source>
   <translation>{column} 的扫描</translation>
  </message>
  <message>
   <source>Side of the column at the top of pictures, for all rows</source>
   <translation>图像上方对应柱的哪一侧，用于所有行</translation>
  </message>
  <message>
   <source>Sleeves</source>
   <translation>套筒</translation>
  </message>
  <message>
   <source>The job has columns that this document lacks: {names}. Sample them first.</source>
   <translation>任务中有本文档没有的柱：{names}。请先提取设计点。</translation>
  </message>
  <message>
   <source>Unit</source>
   <translation>单位</translation>
  </message>
  <message>
   <source>Up</source>
   <translation>上方</translation>
  </message>
  <message>
   <source>What is checked is saved here, as the command aadm reads it</source>
   <translation>检测内容保存在此，命令 aadm 可直接读取</translation>
  </message>
  <message>
   <source>{count} columns: {summary}. Report: {file}</source>
   <translation>{count} 根柱：{summary}。报告：{file}</translation>
  </message>
  <message>
   <source>{count} of {all} columns have scans</source>
   <translation>{all} 根柱中有 {count} 根已有扫描</translation>
  </message>
  <message>
   <source>{file}: there is no such file</source>
   <translation>{file}：没有这个文件</translation>
  </message>
 </context>
 <context>
  <name>AADM_CheckColumn</name>
  <message>
   <source>Check column</source>
   <translation>检测柱</translation>
  </message>
  <message>
   <source>Measures the selected column in its scans, and shows the verdict on it</source>
   <translation>在扫描中测量所选柱，并在柱上显示结论</translation>
  </message>
 </context>
 <context>
  <name>AADM_Design</name>
  <message>
   <source>Apply</source>
   <translation>应用</translation>
  </message>
  <message>
   <source>Change design</source>
   <translation>修改设计点</translation>
  </message>
  <message>
   <source>Design of {column}</source>
   <translation>{column} 的设计点</translation>
  </message>
  <message>
   <source>Diameter</source>
   <translation>直径</translation>
  </message>
  <message>
   <source>Its rebar</source>
   <translation>对应钢筋</translation>
  </message>
  <message>
   <source>Keeps pairing and directions, in one undo step</source>
   <translation>保存配对与方向，可一次撤销</translation>
  </message>
  <message>
   <source>Side of the column at the top of the picture: +x, -x, +y, -y, or degrees from +x</source>
   <translation>图像上方对应柱的哪一侧：+x、-x、+y、-y，或自 +x 起的角度</translation>
  </message>
  <message>
   <source>Sleeve</source>
   <translation>套筒</translation>
  </message>
  <message>
   <source>Two sleeves have the same rebar: give each its own.</source>
   <translation>两个套筒对应同一根钢筋：请各配一根。</translation>
  </message>
  <message>
   <source>Up in pictures of rebars</source>
   <translation>钢筋图像的上方</translation>
  </message>
  <message>
   <source>Up in pictures of sleeves</source>
   <translation>套筒图像的上方</translation>
  </message>
  <message>
   <source>Why</source>
   <translation>依据</translation>
  </message>
  <message>
   <source>no rebar</source>
   <translation>无钢筋</translation>
  </message>
  <message>
   <source>{sleeves} sleeves, {rebars} rebars. Column frame: z up along the column.</source>
   <translation>{sleeves} 个套筒，{rebars} 根钢筋。柱坐标系：z 沿柱向上。</translation>
  </message>
 </context>
 <context>
  <name>AADM_Hoisting</name>
  <message>
   <source>Choose the folder that is measured into</source>
   <translation>请选择存放测量结果的文件夹</translation>
  </message>
  <message>
   <source>Corner</source>
   <translation>角</translation>
  </message>
  <message>
   <source>Folder</source>
   <translation>文件夹</translation>
  </message>
  <message>
   <source>Folder that is measured into</source>
   <translation>存放测量结果的文件夹</translation>
  </message>
  <message>
   <source>Full screen</source>
   <translation>全屏</translation>
  </message>
  <message>
   <source>Hoisting guidance</source>
   <translation>吊装引导</translation>
  </message>
  <message>
   <source>Hoisting guidance…</source>
   <translation>吊装引导…</translation>
  </message>
  <message>
   <source>I stand at the side {side}</source>
   <translation>我站在 {side} 侧</translation>
  </message>
  <message>
   <source>I stand beside the camera</source>
   <translation>我站在相机旁</translation>
  </message>
  <message>
   <source>LOWER</source>
   <translation>下放</translation>
  </message>
  <message>
   <source>Name the column that hangs.</source>
   <translation>请填写吊着的柱的编号。</translation>
  </message>
  <message>
   <source>Nothing is watched from here</source>
   <translation>未从此处启动监测</translation>
  </message>
  <message>
   <source>PUSH</source>
   <translation>推</translation>
  </message>
  <message>
   <source>RECORDED, not live</source>
   <translation>历史记录，非实时</translation>
  </message>
  <message>
   <source>Recorded result</source>
   <translation>历史结果</translation>
  </message>
  <message>
   <source>Recorded result…</source>
   <translation>历史结果…</translation>
  </message>
  <message>
   <source>Shows which way to push and turn the hanging column, from a folder that is measured into</source>
   <translation>根据测量文件夹，显示悬吊柱应向哪边推、转多少</translation>
  </message>
  <message>
   <source>Start watching</source>
   <translation>开始监测</translation>
  </message>
  <message>
   <source>Starting…</source>
   <translation>正在启动…</translation>
  </message>
  <message>
   <source>Stop watching</source>
   <translation>停止监测</translation>
  </message>
  <message>
   <source>Stopping…</source>
   <translation>正在停止…</translation>
  </message>
  <message>
   <source>The corner of the bars that the camera stands at</source>
   <translation>相机所在的钢筋角</translation>
  </message>
  <message>
   <source>The watch has ended</source>
   <translation>监测已结束</translation>
  </message>
  <message>
   <source>This file holds no hoisting frame</source>
   <translation>此文件中没有吊装测量</translation>
  </message>
  <message>
   <source>WAIT</source>
   <translation>等待</translation>
  </message>
  <message>
   <source>Waiting for the first measurement in the folder</source>
   <translation>正在等待文件夹中的第一次测量</translation>
  </message>
  <message>
   <source>Watching: {line}</source>
   <translation>监测中：{line}</translation>
  </message>
  <message>
   <source>as in the job</source>
   <translation>按任务文件</translation>
  </message>
  <message>
   <source>hold here</source>
   <translation>保持不动</translation>
  </message>
  <message>
   <source>margin</source>
   <translation>余量</translation>
  </message>
  <message>
   <source>none: the folder alone</source>
   <translation>无：仅监测文件夹</translation>
  </message>
  <message>
   <source>not measured</source>
   <translation>未测得</translation>
  </message>
  <message>
   <source>{age:.0f} s ago</source>
   <translation>{age:.0f} 秒前</translation>
  </message>
 </context>
 <context>
  <name>AADM_Import</name>
  <message>
   <source>A depth map needs the camera's intrinsics: choose the file that holds them.</source>
   <translation>深度图需要相机内参：请选择内参文件。</translation>
  </message>
  <message>
   <source>A scan belongs to a column, and this document has none: Sample design first.</source>
   <translation>扫描属于某根柱，而此文档还没有柱：请先“提取设计点”。</translation>
  </message>
  <message>
   <source>Camera</source>
   <translation>相机</translation>
  </message>
  <message>
   <source>Choose the file of the scan.</source>
   <translation>请选择扫描文件。</translation>
  </message>
  <message>
   <source>Column</source>
   <translation>柱</translation>
  </message>
  <message>
   <source>Depth step</source>
   <translation>深度步长</translation>
  </message>
  <message>
   <source>File</source>
   <translation>文件</translation>
  </message>
  <message>
   <source>Import</source>
   <translation>导入</translation>
  </message>
  <message>
   <source>Import scan</source>
   <translation>导入扫描</translation>
  </message>
  <message>
   <source>Intrinsics</source>
   <translation>内参</translation>
  </message>
  <message>
   <source>It shows</source>
   <translation>内容</translation>
  </message>
  <message>
   <source>Its unit</source>
   <translation>单位</translation>
  </message>
  <message>
   <source>Millimetres in one step of a 16-bit depth map, where its camera's file has none</source>
   <translation>16 位深度图中一级对应的毫米数；相机文件已给出时不必填写</translation>
  </message>
  <message>
   <source>Scan</source>
   <translation>扫描</translation>
  </message>
  <message>
   <source>Side of the column at the top of the picture; empty: not known</source>
   <translation>图像上方对应柱的哪一侧；留空表示未知</translation>
  </message>
  <message>
   <source>The column is not there any more: choose another.</source>
   <translation>该柱已不存在：请另选一根。</translation>
  </message>
  <message>
   <source>Up in the picture</source>
   <translation>图像上方</translation>
  </message>
  <message>
   <source>not given</source>
   <translation>未给出</translation>
  </message>
  <message>
   <source>rebars (the bars below)</source>
   <translation>钢筋（下层伸出的钢筋）</translation>
  </message>
  <message>
   <source>sleeves (the foot)</source>
   <translation>套筒（柱底）</translation>
  </message>
  <message>
   <source>{file}: {count} points, imported to {column}</source>
   <translation>{file}：{count} 个点，已导入 {column}</translation>
  </message>
 </context>
 <context>
  <name>AADM_ImportScan</name>
  <message>
   <source>Gives the selected column a scan of its sleeves or of its rebars</source>
   <translation>为所选柱导入套筒或钢筋的扫描</translation>
  </message>
  <message>
   <source>Import scan…</source>
   <translation>导入扫描…</translation>
  </message>
 </context>
 <context>
  <name>AADM_Install</name>
  <message>
   <source>A check is running with it: wait until that is done, then try again.</source>
   <translation>有检测正在使用它：请等检测结束后再试。</translation>
  </message>
  <message>
   <source>A package cannot be loaded on this machine; the last line of the log says which and why.</source>
   <translation>有软件包无法在这台机器上加载；日志最后一行说明是哪一个以及原因。</translation>
  </message>
  <message>
   <source>A package was not found. Without a network this is what is said, too: look at the connection, or whether the folder of wheels holds all that requirements/freecad.txt names, for this Python.</source>
   <translation>找不到某个软件包。没有网络时也会这样提示：请检查网络连接，或检查 wheel 文件夹是否包含 requirements/freecad.txt 列出的、适用于此 Python 的全部软件包。</translation>
  </message>
  <message>
   <source>About 30 packages, 180 MB from the network. FreeCAD itself is not changed.</source>
   <translation>约 30 个软件包，从网络下载 180 MB。FreeCAD 本身不作改动。</translation>
  </message>
  <message>
   <source>Another window is installing it: wait until that is done.</source>
   <translation>另一个窗口正在安装：请等它完成。</translation>
  </message>
  <message>
   <source>Copy the log</source>
   <translation>复制日志</translation>
  </message>
  <message>
   <source>Folder of wheels</source>
   <translation>wheel 文件夹</translation>
  </message>
  <message>
   <source>From a folder of wheels…</source>
   <translation>从 wheel 文件夹安装…</translation>
  </message>
  <message>
   <source>Install</source>
   <translation>安装</translation>
  </message>
  <message>
   <source>Installed. Repeat the command.</source>
   <translation>已安装。请重新执行命令。</translation>
  </message>
  <message>
   <source>Installing what AADM needs</source>
   <translation>正在安装 AADM 所需的软件包</translation>
  </message>
  <message>
   <source>It was not installed; nothing is left of it.</source>
   <translation>没有安装；没有留下任何文件。</translation>
  </message>
  <message>
   <source>No Python from 3.11 to 3.14 was found: install one (on Debian: apt-get install python3), or name one in the settings of AADM.</source>
   <translation>找不到 3.11 至 3.14 版的 Python：请安装一个（Debian：apt-get install python3），或在 AADM 的设置中指定一个。</translation>
  </message>
  <message>
   <source>Remove</source>
   <translation>移除</translation>
  </message>
  <message>
   <source>Repair</source>
   <translation>修复</translation>
  </message>
  <message>
   <source>The disk is full: 1 GB is needed.</source>
   <translation>磁盘空间不足：需要 1 GB。</translation>
  </message>
  <message>
   <source>The folder cannot be written; the last line of the log says which.</source>
   <translation>无法写入文件夹；日志最后一行说明是哪一个。</translation>
  </message>
  <message>
   <source>The network cannot be reached. Try again later, or install from a folder of wheels.</source>
   <translation>无法连接网络。请稍后再试，或从 wheel 文件夹安装。</translation>
  </message>
  <message>
   <source>The proxy refuses: name it in pip's settings (proxy).</source>
   <translation>代理服务器拒绝连接：请在 pip 的设置（proxy）中指定代理。</translation>
  </message>
  <message>
   <source>The server's certificate is not trusted here: name your company's in pip's settings (cert).</source>
   <translation>本机不信任服务器的证书：请在 pip 的设置（cert）中指定公司的证书。</translation>
  </message>
  <message>
   <source>Try again</source>
   <translation>重试</translation>
  </message>
  <message>
   <source>pip could not install it; the log says why.</source>
   <translation>pip 无法安装；原因见日志。</translation>
  </message>
 </context>
 <context>
  <name>AADM_Job</name>
  <message>
   <source>Choose the job file: a .toml as the manual describes it.</source>
   <translation>请选择任务文件：手册所述的 .toml 文件。</translation>
  </message>
  <message>
   <source>Empty: a folder beside the job file, called after it</source>
   <translation>留空：任务文件旁的同名文件夹</translation>
  </message>
  <message>
   <source>Job</source>
   <translation>任务</translation>
  </message>
  <message>
   <source>Job file</source>
   <translation>任务文件</translation>
  </message>
  <message>
   <source>Report folder</source>
   <translation>报告文件夹</translation>
  </message>
  <message>
   <source>Results of a job</source>
   <translation>任务结果</translation>
  </message>
  <message>
   <source>Run</source>
   <translation>运行</translation>
  </message>
  <message>
   <source>Run job</source>
   <translation>运行任务</translation>
  </message>
  <message>
   <source>{count} columns: {summary}. Report: {file}</source>
   <translation>{count} 根柱：{summary}。报告：{file}</translation>
  </message>
 </context>
 <context>
  <name>AADM_Preferences</name>
  <message>
   <source>An aadm that you have installed yourself, of the same version; it is used instead of the private environment</source>
   <translation>您自己安装的、版本相同的 aadm；用它代替专用运行环境</translation>
  </message>
  <message>
   <source>Camera file</source>
   <translation>相机文件</translation>
  </message>
  <message>
   <source>Decision rule</source>
   <translation>判定规则</translation>
  </message>
  <message>
   <source>General</source>
   <translation>常规</translation>
  </message>
  <message>
   <source>Intrinsics that Import scan offers: .toml, .json or the text of the camera</source>
   <translation>“导入扫描”默认使用的内参：.toml、.json 或相机输出的文本</translation>
  </message>
  <message>
   <source>Method</source>
   <translation>方法</translation>
  </message>
  <message>
   <source>More points show more and turn slower; checks use all points in any case</source>
   <translation>点越多显示越细、转动越慢；检测总是使用全部点</translation>
  </message>
  <message>
   <source>Of new columns: a built-in name such as cn, or the path of a .toml file</source>
   <translation>用于新柱：内置名称（如 cn）或 .toml 文件路径</translation>
  </message>
  <message>
   <source>Of new columns; all but refined are methods of the literature</source>
   <translation>用于新柱；除 refined 外均为文献方法</translation>
  </message>
  <message>
   <source>Of new columns; guarded: 95 % certainty, simple: the value alone</source>
   <translation>用于新柱；guarded：95 % 置信，simple：只比较数值</translation>
  </message>
  <message>
   <source>Of the labels in the 3-D view, points</source>
   <translation>三维视图中标签的字号（磅）</translation>
  </message>
  <message>
   <source>Own aadm</source>
   <translation>自己的 aadm</translation>
  </message>
  <message>
   <source>Points of a scan shown at most</source>
   <translation>扫描最多显示的点数</translation>
  </message>
  <message>
   <source>Python</source>
   <translation>Python</translation>
  </message>
  <message>
   <source>Scans are imported in</source>
   <translation>扫描导入单位</translation>
  </message>
  <message>
   <source>Size of labels</source>
   <translation>标签字号</translation>
  </message>
  <message>
   <source>The private environment is made for it, 3.11 to 3.14; empty: one is looked for</source>
   <translation>专用运行环境为它建立，3.11 至 3.14 版；留空则自动查找</translation>
  </message>
  <message>
   <source>Tolerance profile</source>
   <translation>允许偏差标准</translation>
  </message>
  <message>
   <source>Unit of scan files; it is never guessed</source>
   <translation>扫描文件的单位；绝不猜测</translation>
  </message>
 </context>
 <context>
  <name>AADM_Report</name>
  <message>
   <source>BCF topics for the BIM coordinator</source>
   <translation>BCF 议题（供 BIM 协调）</translation>
  </message>
  <message>
   <source>CSV tables</source>
   <translation>CSV 表格</translation>
  </message>
  <message>
   <source>Card for scanning</source>
   <translation>扫描指示卡</translation>
  </message>
  <message>
   <source>Choose the folder to write into.</source>
   <translation>请选择输出文件夹。</translation>
  </message>
  <message>
   <source>Excel workbook</source>
   <translation>Excel 工作簿</translation>
  </message>
  <message>
   <source>Folder</source>
   <translation>文件夹</translation>
  </message>
  <message>
   <source>FreeCAD document of the results</source>
   <translation>仅含结果的 FreeCAD 文档</translation>
  </message>
  <message>
   <source>HTML, one file to read and keep</source>
   <translation>HTML，单个文件，便于阅读和存档</translation>
  </message>
  <message>
   <source>PDF</source>
   <translation>PDF</translation>
  </message>
  <message>
   <source>Page for the crew</source>
   <translation>班组作业单</translation>
  </message>
  <message>
   <source>Picture of the 3-D view</source>
   <translation>三维视图图片</translation>
  </message>
  <message>
   <source>Report</source>
   <translation>报告</translation>
  </message>
  <message>
   <source>Report…</source>
   <translation>报告…</translation>
  </message>
  <message>
   <source>Write</source>
   <translation>写入</translation>
  </message>
  <message>
   <source>Writes report.json, and from it reports for people, of all results</source>
   <translation>写出 report.json，并由其生成供人阅读的报告</translation>
  </message>
  <message>
   <source>Written: {folder}</source>
   <translation>已写出：{folder}</translation>
  </message>
  <message>
   <source>report.json is always written. And:</source>
   <translation>总是写出 report.json。另外：</translation>
  </message>
 </context>
 <context>
  <name>AADM_Rows</name>
  <message>
   <source>distance in the trial</source>
   <translation>试装间距</translation>
  </message>
  <message>
   <source>position</source>
   <translation>位置</translation>
  </message>
  <message>
   <source>position in the building</source>
   <translation>绝对位置</translation>
  </message>
  <message>
   <source>spacing</source>
   <translation>间距</translation>
  </message>
 </context>
 <context>
  <name>AADM_RunJob</name>
  <message>
   <source>Checks all columns of a job file, and shows the results on the columns</source>
   <translation>检测任务文件中的所有柱，并在柱上显示结果</translation>
  </message>
  <message>
   <source>Run job…</source>
   <translation>运行任务…</translation>
  </message>
 </context>
 <context>
  <name>AADM_SampleDesign</name>
  <message>
   <source>IFC file…</source>
   <translation>IFC 文件…</translation>
  </message>
  <message>
   <source>Sample</source>
   <translation>提取</translation>
  </message>
  <message>
   <source>Sample design</source>
   <translation>提取设计点</translation>
  </message>
  <message>
   <source>Take the columns of an IFC file</source>
   <translation>从 IFC 文件读取柱</translation>
  </message>
  <message>
   <source>Takes sleeves and rebars from the selected columns of the model, or from all columns where none is selected</source>
   <translation>从模型中所选的柱提取套筒和钢筋；未选择时提取所有柱</translation>
  </message>
  <message>
   <source>There is no model yet: open or import one first, or take the columns of an IFC file.</source>
   <translation>还没有模型：请先打开或导入模型，或从 IFC 文件中提取柱。</translation>
  </message>
  <message>
   <source>{count} columns were sampled</source>
   <translation>已提取 {count} 根柱</translation>
  </message>
 </context>
 <context>
  <name>AADM_SavePicture</name>
  <message>
   <source>No 3-D view is in front: open a document.</source>
   <translation>当前没有三维视图：请打开文档。</translation>
  </message>
  <message>
   <source>Save picture</source>
   <translation>保存图片</translation>
  </message>
  <message>
   <source>Save picture…</source>
   <translation>保存图片…</translation>
  </message>
  <message>
   <source>Saves the 3-D view as it is now, for reports</source>
   <translation>保存当前三维视图，用于报告</translation>
  </message>
 </context>
 <context>
  <name>AADM_Settings</name>
  <message>
   <source>Method, tolerances, units and what the 3-D view shows</source>
   <translation>方法、允许偏差、单位和三维显示</translation>
  </message>
  <message>
   <source>Settings…</source>
   <translation>设置…</translation>
  </message>
 </context>
 <context>
  <name>AADM_Table</name>
  <message>
   <source>Clause</source>
   <translation>条款</translation>
  </message>
  <message>
   <source>Deviation</source>
   <translation>偏差</translation>
  </message>
  <message>
   <source>Limit</source>
   <translation>限值</translation>
  </message>
  <message>
   <source>Point</source>
   <translation>点</translation>
  </message>
  <message>
   <source>What</source>
   <translation>项目</translation>
  </message>
 </context>
 <context>
  <name>AADM_TryIt</name>
  <message>
   <source>Opens a floor of eight sample columns, checks their synthetic scans, and shows which ones fail</source>
   <translation>打开有八根样例柱的楼层，检测它们的合成扫描，并显示哪些不合格</translation>
  </message>
  <message>
   <source>Try it</source>
   <translation>试用</translation>
  </message>
  <message>
   <source>{folder}: the samples are not there; install the addon as a clone</source>
   <translation>{folder}：没有样例；请以克隆方式安装插件</translation>
  </message>
 </context>
 <context>
  <name>AADM_Write</name>
  <message>
   <source>A copy of it as it was is kept beside it</source>
   <translation>旁边保留一份原样的副本</translation>
  </message>
  <message>
   <source>Change the file itself</source>
   <translation>直接修改该文件</translation>
  </message>
  <message>
   <source>Choose the IFC file that the model came from.</source>
   <translation>请选择模型所来自的 IFC 文件。</translation>
  </message>
  <message>
   <source>Empty: MODEL-checked.ifc beside the file</source>
   <translation>留空：写到该文件旁的 MODEL-checked.ifc</translation>
  </message>
  <message>
   <source>Even if it has changed</source>
   <translation>即使文件已改动</translation>
  </message>
  <message>
   <source>IFC file</source>
   <translation>IFC 文件</translation>
  </message>
  <message>
   <source>Into the model's IFC file</source>
   <translation>写入模型的 IFC 文件</translation>
  </message>
  <message>
   <source>Onto the model's objects</source>
   <translation>写到模型对象上</translation>
  </message>
  <message>
   <source>Results were written into {file}</source>
   <translation>结果已写入 {file}</translation>
  </message>
  <message>
   <source>Results were written onto {count} objects of the model</source>
   <translation>结果已写到 {count} 个模型对象上</translation>
  </message>
  <message>
   <source>Since the check: columns are then found by their GlobalIds</source>
   <translation>检测之后的改动；此时按 GlobalId 查找柱</translation>
  </message>
  <message>
   <source>Then save the document</source>
   <translation>随后保存文档</translation>
  </message>
  <message>
   <source>Write</source>
   <translation>写入</translation>
  </message>
  <message>
   <source>Write results to model</source>
   <translation>将结果写入模型</translation>
  </message>
  <message>
   <source>Written to</source>
   <translation>输出到</translation>
  </message>
 </context>
 <context>
  <name>AADM_WriteResults</name>
  <message>
   <source>Write results to model…</source>
   <translation>将结果写入模型…</translation>
  </message>
  <message>
   <source>Writes the results onto the objects of the model, and into its IFC file</source>
   <translation>将结果写到模型对象上，并写入其 IFC 文件</translation>
  </message>
 </context>
 <context>
  <name>App::Property</name>
  <message>
   <source>A check has laid it on the design; before, its place is a guess</source>
   <translation>检测已将其对准设计；此前的位置只是估计</translation>
  </message>
  <message>
   <source>Arrows are this many times as long as the deviations; 0: chosen to fit</source>
   <translation>箭头长度是偏差的倍数；0：自动选择</translation>
  </message>
  <message>
   <source>Body of the column, as its model draws it: thin, in the column frame</source>
   <translation>模型中的柱体（简化），柱坐标系</translation>
  </message>
  <message>
   <source>Column frame in the frame of the model's object</source>
   <translation>柱坐标系在模型对象坐标系中的位置</translation>
  </message>
  <message>
   <source>Connecting rebars of the design</source>
   <translation>设计中的连接钢筋数</translation>
  </message>
  <message>
   <source>Design points</source>
   <translation>设计点</translation>
  </message>
  <message>
   <source>Distance at which the colours end; points beyond are grey</source>
   <translation>色标的最大距离；更远的点为灰色</translation>
  </message>
  <message>
   <source>Distance from the design, or one colour</source>
   <translation>按与设计的距离着色，或单色</translation>
  </message>
  <message>
   <source>Distance of each thinned point from the design</source>
   <translation>各抽稀点与设计的距离</translation>
  </message>
  <message>
   <source>Draw over everything: the foot is inside the column's own concrete</source>
   <translation>显示在最前：柱底被柱体混凝土遮挡</translation>
  </message>
  <message>
   <source>File that the design was taken from</source>
   <translation>设计所取自的文件</translation>
  </message>
  <message>
   <source>Form of this object; newer versions of the workbench bring it up to date</source>
   <translation>此对象的格式；新版工作台会自动升级</translation>
  </message>
  <message>
   <source>From the column's check by AADM</source>
   <translation>来自 AADM 对该柱的检测</translation>
  </message>
  <message>
   <source>GlobalId in IFC</source>
   <translation>IFC 中的 GlobalId</translation>
  </message>
  <message>
   <source>GlobalId of the project in that file, where it is IFC</source>
   <translation>该文件为 IFC 时，其中项目的 GlobalId</translation>
  </message>
  <message>
   <source>Grid axes</source>
   <translation>轴线</translation>
  </message>
  <message>
   <source>Hash of that file when it was read</source>
   <translation>读取时该文件的哈希值</translation>
  </message>
  <message>
   <source>Hash of the design points as they were sampled</source>
   <translation>提取时设计点的哈希值</translation>
  </message>
  <message>
   <source>Hash of the file as it was imported</source>
   <translation>导入时文件的哈希值</translation>
  </message>
  <message>
   <source>How centres are found in a scan</source>
   <translation>在扫描中提取中心的方法</translation>
  </message>
  <message>
   <source>Intrinsics of the camera, where they are known</source>
   <translation>相机内参（如已知）</translation>
  </message>
  <message>
   <source>Its last result</source>
   <translation>最近一次结果</translation>
  </message>
  <message>
   <source>Its scans</source>
   <translation>其扫描</translation>
  </message>
  <message>
   <source>Job file that it was last checked by, together with others</source>
   <translation>上一次与其他柱一同检测所用的任务文件</translation>
  </message>
  <message>
   <source>Largest deviation of a rebar from its design place</source>
   <translation>钢筋与设计位置的最大偏差</translation>
  </message>
  <message>
   <source>Largest deviation of a sleeve from its design place</source>
   <translation>套筒与设计位置的最大偏差</translation>
  </message>
  <message>
   <source>Largest distance of a rebar from its sleeve in the best position (minimax)</source>
   <translation>最佳位置（最小最大）下钢筋与套筒的最大间距</translation>
  </message>
  <message>
   <source>Millimetres in one step of a 16-bit depth map; 0: not given</source>
   <translation>16 位深度图每级的毫米数；0：未给出</translation>
  </message>
  <message>
   <source>Name of this object when it was made: a copy has another</source>
   <translation>此对象创建时的名称：副本的名称不同</translation>
  </message>
  <message>
   <source>Piece mark</source>
   <translation>构件编号</translation>
  </message>
  <message>
   <source>Points of the file; the view shows fewer</source>
   <translation>文件中的点数；视图显示较少</translation>
  </message>
  <message>
   <source>Pose in the play that leads the tower back to the grid, for the job</source>
   <translation>间隙内使柱顶回到轴网的位置，供任务使用</translation>
  </message>
  <message>
   <source>Positions against the design, or the trial assembly: minimax, or least squares</source>
   <translation>与设计比较的位置，或试装：最小最大、最小二乘</translation>
  </message>
  <message>
   <source>Program and version that it was checked with</source>
   <translation>检测所用程序及版本</translation>
  </message>
  <message>
   <source>Scan frame in the column frame</source>
   <translation>扫描坐标系在柱坐标系中的位置</translation>
  </message>
  <message>
   <source>Show deviation arrows</source>
   <translation>显示偏差箭头</translation>
  </message>
  <message>
   <source>Show the body of the column as its model draws it</source>
   <translation>显示模型中的柱体</translation>
  </message>
  <message>
   <source>Side of the column at the top of pictures of its rebars: +x, -x, +y, -y</source>
   <translation>钢筋图像上方对应柱的哪一侧：+x、-x、+y、-y</translation>
  </message>
  <message>
   <source>Side of the column at the top of pictures of its sleeves: +x, -x, +y, -y</source>
   <translation>套筒图像上方对应柱的哪一侧：+x、-x、+y、-y</translation>
  </message>
  <message>
   <source>Size of a point, pixels</source>
   <translation>点的大小（像素）</translation>
  </message>
  <message>
   <source>Sleeves of the design</source>
   <translation>设计中的套筒数</translation>
  </message>
  <message>
   <source>Storey</source>
   <translation>楼层</translation>
  </message>
  <message>
   <source>The column may be turned by its own symmetry</source>
   <translation>允许按柱自身的对称性旋转</translation>
  </message>
  <message>
   <source>The job's part</source>
   <translation>任务部分</translation>
  </message>
  <message>
   <source>The object of the model that this column is</source>
   <translation>此柱对应的模型对象</translation>
  </message>
  <message>
   <source>The report</source>
   <translation>报告</translation>
  </message>
  <message>
   <source>The scan's file</source>
   <translation>扫描文件</translation>
  </message>
  <message>
   <source>Thinned points, scan frame</source>
   <translation>抽稀的点（扫描坐标系）</translation>
  </message>
  <message>
   <source>Tolerance profile: a built-in name, or the path of a .toml file</source>
   <translation>允许偏差标准：内置名称或 .toml 文件路径</translation>
  </message>
  <message>
   <source>Unit of the file's lengths; it is never guessed</source>
   <translation>文件的长度单位；绝不猜测</translation>
  </message>
  <message>
   <source>Verdict of the trial assembly alone</source>
   <translation>仅试装的结论</translation>
  </message>
  <message>
   <source>Verdict on the top of the set column</source>
   <translation>就位后柱顶的结论</translation>
  </message>
  <message>
   <source>What it shows: the sleeves of the foot, or the rebars</source>
   <translation>内容：柱底套筒或钢筋</translation>
  </message>
  <message>
   <source>What jobs and reports call it</source>
   <translation>任务和报告中的名称</translation>
  </message>
  <message>
   <source>What stands against it</source>
   <translation>不合格原因</translation>
  </message>
  <message>
   <source>When it was checked (UTC), where that is known</source>
   <translation>检测时间（UTC，如已知）</translation>
  </message>
  <message>
   <source>Where the top comes to, against what, with its standard uncertainty</source>
   <translation>就位后柱顶的偏差、其基准及标准不确定度</translation>
  </message>
  <message>
   <source>Which points are labelled</source>
   <translation>标注哪些点</translation>
  </message>
  <message>
   <source>guarded: decide with 95 % certainty; simple: compare the value alone</source>
   <translation>guarded：以 95 % 置信判定；simple：只比较数值</translation>
  </message>
  <message>
   <source>pass, fail, inconclusive, not_measured or error</source>
   <translation>pass 合格、fail 不合格、inconclusive 不确定、not_measured 未测得、error 出错</translation>
  </message>
 </context>
 <context>
  <name>Workbench</name>
  <message>
   <source>AADM</source>
   <translation>AADM</translation>
  </message>
 </context>
</TS>
